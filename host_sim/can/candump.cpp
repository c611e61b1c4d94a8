// The format is that of can-utils: lib.c's parse_canframe() and sprint_canframe() for the frame,
// candump.c for what stands around it.
#include "can/candump.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace servoid::can {

namespace {

constexpr std::uint32_t highest_standard = 0x7ff, highest_extended = 0x1fffffff;
constexpr int classic_bytes = 8, fd_bytes = 64;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::uint64_t most_seconds = std::numeric_limits<std::int64_t>::max() / second_ns - 1;
constexpr size_t most_interfaces = 256; // what Frame::interface counts to
constexpr const char* such_as = "; expected a line such as (1436509052.249713) can0 181#0102";

constexpr std::array<std::int8_t, 256> make_nibbles() {
    std::array<std::int8_t, 256> nibbles{};
    nibbles.fill(-1);
    for (int i = 0; i < 10; ++i)
        nibbles[static_cast<size_t>('0' + i)] = static_cast<std::int8_t>(i);
    for (int i = 0; i < 6; ++i)
        nibbles[static_cast<size_t>('a' + i)] = nibbles[static_cast<size_t>('A' + i)] =
            static_cast<std::int8_t>(10 + i);
    return nibbles;
}
constexpr std::array<std::int8_t, 256> nibbles = make_nibbles();

int nibble(char c) { return nibbles[static_cast<unsigned char>(c)]; } // -1: no hexadecimal digit
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

bool is_fd_length(int bytes) {
    return bytes <= 8 || (bytes <= 24 && bytes % 4 == 0) || bytes == 32 || bytes == 48 ||
           bytes == 64;
}

// Why a line is wrong, and from where on. Where that is the line's end, a line without end may just
// have been cut there.
struct Fault {
    const char* at;
    std::string reason;
};

// Reads one line from left to right: every byte of a log passes here once.
class Line {
  public:
    explicit Line(std::string_view line) : at_(line.data()), end_(at_ + line.size()) {}

    std::int64_t read_time() {
        if (peek() != '(') fail(at_, in_quotes(rest(at_)) + " is no frame" + such_as);
        const char* const first = ++at_;
        const std::uint64_t seconds = read_decimal();
        const auto digits = at_ - first;
        const std::int64_t nanoseconds = peek() == '.' ? read_fraction(first) : 0;
        if (peek() != ')' || digits == 0) time_mistake(first);
        if (digits > 10 || seconds > most_seconds)
            fail(first, fmt::format("time {} is out of range; expected at most {} s",
                                    in_quotes({first, size_t(at_ - first)}), most_seconds));
        ++at_;
        return static_cast<std::int64_t>(seconds) * second_ns + nanoseconds;
    }

    std::string_view read_interface() {
        const bool apart = skip_blanks();
        if (!apart || at_ == end_) fail(at_, std::string("no interface after the time") + such_as);
        const char* const first = at_;
        bool is_frame = false;
        for (; at_ != end_ && !is_blank(*at_); ++at_)
            is_frame |= *at_ == '#';
        if (is_frame)
            fail(first, "no interface before the frame " + in_quotes(word(first)) + such_as);
        return {first, size_t(at_ - first)};
    }

    void read_frame(Frame& frame) {
        skip_blanks();
        if (at_ == end_) fail(at_, std::string("no frame after the interface") + such_as);
        const char* const first = at_;
        read_id(frame);
        const char kind = peek();
        if (kind == '#')
            read_fd(frame);
        else if (kind == 'R' || kind == 'r')
            read_remote(frame);
        else
            read_classic(frame);
        if (frame.error && (frame.fd || frame.remote))
            fail(first, "error frame " + in_quotes(word(first)) +
                            " is marked as remote or FD; expected a classic one with data");
        read_direction();
    }

    // `DROPCOUNT: dropped 3 CAN frames on 'can0' socket (total drops 5)`: of candump -d.
    std::uint64_t read_dropped() {
        const char* const first = at_;
        for (const char c : std::string_view("DROPCOUNT: dropped ")) {
            if (peek() != c) fail(at_, in_quotes(rest(first)) + " is no frame" + such_as);
            ++at_;
        }
        const char* const number = at_;
        const std::uint64_t frames = read_decimal();
        const auto digits = at_ - number;
        // candump counts in 32 bit
        if (digits == 0 || digits > 10 || !is_blank(peek()))
            fail(at_,
                 in_quotes(rest(first)) +
                     " does not say how many frames; expected DROPCOUNT: dropped N CAN frames");
        return frames;
    }

  private:
    [[noreturn]] static void fail(const char* at, std::string reason) {
        throw Fault{at, std::move(reason)};
    }

    char peek() const { return at_ != end_ ? *at_ : '\0'; }
    bool at_word_end() const { return at_ == end_ || is_blank(*at_); }
    std::string_view rest(const char* from) const { return {from, size_t(end_ - from)}; }
    std::string_view word(const char* from) const {
        return {from, size_t(std::find_if(from, end_, is_blank) - from)};
    }

    bool skip_blanks() {
        const char* const first = at_;
        while (at_ != end_ && is_blank(*at_))
            ++at_;
        return at_ != first;
    }

    // As many digits as there are; more than 19 are for the caller to refuse.
    std::uint64_t read_decimal() {
        std::uint64_t number = 0;
        for (; at_ != end_ && is_digit(*at_); ++at_)
            number = 10 * number + static_cast<std::uint64_t>(*at_ - '0');
        return number;
    }

    std::int64_t read_fraction(const char* time) {
        static constexpr std::int64_t unit[] = {
            second_ns, 100'000'000, 10'000'000, 1'000'000, 100'000, 10'000, 1'000, 100, 10, 1};
        const char* const first = ++at_;
        const std::uint64_t number = read_decimal();
        const auto digits = at_ - first;
        if (digits == 0 || digits > 9) time_mistake(time);
        return static_cast<std::int64_t>(number) * unit[digits];
    }

    [[noreturn]] void time_mistake(const char* first) const {
        const char* const close = std::find(first, end_, ')');
        if (close == end_) fail(at_, std::string("no \")\" after the time") + such_as);
        fail(first, "time " + in_quotes({first, size_t(close - first)}) +
                        " is no number of seconds; expected digits with up to 9 decimals, such as "
                        "1436509052.249713");
    }

    void read_id(Frame& frame) {
        const char* const first = at_;
        std::uint32_t id = 0;
        for (int digit = 0; at_ != end_ && (digit = nibble(*at_)) >= 0; ++at_)
            id = id << 4 | static_cast<std::uint32_t>(digit);
        if (peek() != '#') id_mistake(first);
        const std::string_view digits{first, size_t(at_ - first)};
        if (digits.size() == 3)
            check_standard(id, digits);
        else if (digits.size() == 8)
            check_extended(id, digits);
        else
            id_length_mistake(digits);
        frame.error = (id & error_flag) != 0;
        frame.extended = digits.size() == 8 && !frame.error;
        frame.id = id & highest_extended;
        ++at_;
    }

    static void check_standard(std::uint32_t id, std::string_view digits) {
        if (id > highest_standard)
            fail(digits.data(),
                 "identifier " + in_quotes(digits) +
                     " is above 7FF; expected one of 11 bit, or 8 digits for 29 bit");
    }

    static void check_extended(std::uint32_t id, std::string_view digits) {
        if (id > (highest_extended | error_flag))
            fail(digits.data(), "identifier " + in_quotes(digits) +
                                    " is above 1FFFFFFF; expected one of 29 bit, or 20000000 "
                                    "added to an error class");
    }

    [[noreturn]] static void id_length_mistake(std::string_view digits) {
        if (digits.size() == 5)
            fail(digits.data(), "identifier " + in_quotes(digits) +
                                    " has 5 digits: CAN XL is not supported; expected 3 or 8");
        fail(digits.data(), fmt::format("identifier {} has {} digits; expected 3 (11 bit) or 8",
                                        in_quotes(digits), digits.size()));
    }

    [[noreturn]] void id_mistake(const char* first) const {
        const std::string_view frame = word(first);
        const auto hash = frame.find('#');
        if (hash == std::string_view::npos)
            fail(at_, "no \"#\" in the frame " + in_quotes(frame) + such_as);
        fail(at_, "identifier " + in_quotes(frame.substr(0, hash)) +
                      " is no hexadecimal number; expected 3 or 8 digits");
    }

    void read_fd(Frame& frame) {
        ++at_;
        const int flags = nibble(peek());
        if (flags < 0) fail(at_, "no flags after \"##\"; expected a digit, as in 181##10102");
        ++at_;
        frame.fd = true;
        frame.fd_flags = static_cast<std::uint8_t>(flags);
        const int bytes = read_data(frame, fd_bytes);
        if (!at_word_end()) data_mistake(bytes, fd_bytes);
        if (!is_fd_length(bytes))
            fail(at_, fmt::format("FD frame of {} bytes; expected 0 to 8, 12, 16, 20, 24, 32, 48 "
                                  "or 64",
                                  bytes));
    }

    void read_remote(Frame& frame) {
        frame.remote = true;
        ++at_;
        if (at_word_end()) return;
        if (*at_ < '0' || *at_ > '8')
            fail(at_, "remote frame asks for " + in_quotes(word(at_)) +
                          "; expected a length from 0 to 8, or none");
        frame.length = static_cast<std::uint8_t>(*at_ - '0');
        ++at_;
        skip_length_code(frame.length);
        if (!at_word_end())
            fail(at_, in_quotes(word(at_)) + " after the length of a remote frame; expected none");
    }

    void read_classic(Frame& frame) {
        const int bytes = read_data(frame, classic_bytes);
        skip_length_code(bytes);
        if (!at_word_end()) data_mistake(bytes, classic_bytes);
    }

    // Bytes may be parted by points: `11.22.33`.
    int read_data(Frame& frame, int most) {
        int bytes = 0;
        while (bytes < most && end_ - at_ >= 2) {
            const int high = nibble(at_[0]), low = nibble(at_[1]);
            if ((high | low) >= 0) {
                frame.data[static_cast<size_t>(bytes++)] =
                    static_cast<std::uint8_t>(high << 4 | low);
                at_ += 2;
            } else if (*at_ == '.' && low >= 0)
                ++at_;
            else
                break;
        }
        frame.length = static_cast<std::uint8_t>(bytes);
        return bytes;
    }

    // `_9` to `_F`: a classic frame of 8 bytes whose length code on the wire was above 8.
    void skip_length_code(int bytes) {
        if (bytes != classic_bytes || peek() != '_') return;
        const char* const first = ++at_;
        const bool above = nibble(peek()) > classic_bytes;
        if (above) ++at_;
        if (!above || !at_word_end())
            fail(at_, "length code " + in_quotes(word(first)) + " after \"_\"; expected 9 to F");
    }

    [[noreturn]] void data_mistake(int bytes, int most) const {
        const bool digit = nibble(*at_) >= 0;
        if (digit && bytes == most)
            fail(at_, fmt::format("more than {} bytes of data; expected at most {}{}", most, most,
                                  most == classic_bytes ? ", or \"##\" for an FD frame" : ""));
        const char* const second_digit = at_ + 1;
        if (digit && (second_digit == end_ || is_blank(*second_digit)))
            fail(second_digit, "data have an odd number of digits; expected two for each byte");
        const char* const wrong = digit ? second_digit : at_;
        fail(wrong, in_quotes({wrong, 1}) + " in the data is no hexadecimal digit; expected two " +
                        "for each byte");
    }

    // candump -x: R for received, T for sent.
    void read_direction() {
        skip_blanks();
        if (at_ == end_) return;
        const char* const first = at_;
        const bool known = std::strchr("RTrt", *at_) != nullptr && *at_ != '\0';
        ++at_;
        skip_blanks();
        if (!known || at_ != end_)
            fail(first, in_quotes(rest(first)) + " after the frame; expected nothing, or R or T");
    }

    const char* at_;
    const char* const end_;
};

void check_name(const char* at, std::string_view name) {
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (!is_utf8(name) || std::any_of(name.begin(), name.end(), control))
        throw Fault{at,
                    "interface " + in_quotes(name) + " is no text; expected a name such as can0"};
}

} // namespace

CandumpReader::CandumpReader(std::string_view text, std::string path)
    : rest_(text), path_(std::move(path)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

bool CandumpReader::next(Frame& frame) {
    std::string_view line;
    while (next_line(line)) {
        try {
            if (read_line(line, frame)) return true;
        } catch (const Fault& fault) {
            const bool cut = truncated_ && fault.at == line.data() + line.size();
            if (!cut) throw FileError(path_, line_, fault.reason);
        }
    }
    return false;
}

// Without its end; false at the end of the text.
bool CandumpReader::next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    ++line_;
    const void* newline = std::memchr(rest_.data(), '\n', rest_.size());
    truncated_ = newline == nullptr;
    const size_t length =
        truncated_ ? rest_.size() : size_t(static_cast<const char*>(newline) - rest_.data());
    line = rest_.substr(0, length);
    rest_.remove_prefix(truncated_ ? length : length + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
}

// Whether it holds a frame.
bool CandumpReader::read_line(std::string_view line, Frame& frame) {
    if (line.empty() || line[0] == '#' || trim(line).empty()) return false;
    Line rest(line);
    if (line[0] == 'D') {
        dropped_ += rest.read_dropped();
        return false;
    }
    frame = {};
    frame.time_ns = rest.read_time();
    const std::string_view interface = rest.read_interface();
    rest.read_frame(frame);
    frame.interface = interface_index(interface);
    return true;
}

std::uint8_t CandumpReader::interface_index(std::string_view name) {
    for (size_t i = 0; i < interfaces_.size(); ++i)
        if (interfaces_[i] == name) return static_cast<std::uint8_t>(i);
    check_name(name.data(), name);
    if (interfaces_.size() == most_interfaces)
        throw Fault{name.data(), fmt::format("interface {} is one more than the {} that are "
                                             "supported; expected fewer",
                                             in_quotes(name), most_interfaces)};
    interfaces_.emplace_back(name);
    return static_cast<std::uint8_t>(interfaces_.size() - 1);
}

} // namespace servoid::can
