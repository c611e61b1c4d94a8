#include "can/dbc.hpp"

#include "can/dbc_tokens.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace servoid::can {

namespace {

constexpr std::uint32_t extended_bit = 0x8000'0000;
constexpr std::uint32_t independent_signals = 0xc000'0000; // the "message" of signals of none
constexpr int longest_message = 64;

constexpr auto message_form = "a message reads BO_ ID NAME: BYTES SENDER";
constexpr auto signal_form = "a signal reads SG_ NAME : START|BITS@ORDER+ (SCALE,OFFSET) [MIN|MAX] "
                             "\"UNIT\" RECEIVERS";
constexpr auto float_form = "a float reads SIG_VALTYPE_ ID SIGNAL : 1;";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
    });
}

// Units come in the code page of whoever's Windows. What of CP1252 is not Latin-1 becomes `?`.
std::string utf8_of(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80)
            utf8 += c;
        else if (byte < 0xa0)
            utf8 += '?';
        else
            utf8 += {static_cast<char>(0xc0 | byte >> 6), static_cast<char>(0x80 | (byte & 0x3f))};
    }
    return utf8;
}

class Parser {
  public:
    Parser(std::string_view text, const std::string& path) : tokens_(dbc_tokens(text, path)) {
        dbc_.path = path;
    }

    Dbc parse() {
        while (peek().kind != TokenKind::end)
            read_section();
        if (dbc_.messages.empty())
            throw FileError(dbc_.path, 0, "holds no message; expected a DBC file, with BO_ lines");
        return std::move(dbc_);
    }

  private:
    const Token& peek(size_t ahead = 0) const {
        return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
    }
    const Token& next() {
        const Token& token = peek();
        ++at_;
        return token;
    }

    // line_ and form_ are those of the section that is being read.
    [[noreturn]] void fail(const std::string& reason) const {
        throw FileError(dbc_.path, line_, reason);
    }
    [[noreturn]] void fail_at(const Token& found, const std::string& wanted) const {
        const bool ended = found.kind == TokenKind::end || is_keyword(found);
        fail((ended ? "ends" : "has " + in_quotes(found.text)) + " where " + wanted +
             " should be; " + form_);
    }

    void read_section() {
        const Token& first = next();
        const std::string_view keyword = first.kind == TokenKind::word ? first.text : "";
        line_ = first.line;
        if (keyword == "BO_") return read_message();
        if (keyword == "SG_") return read_signal();
        message_ = nullptr;
        if (keyword == "SIG_VALTYPE_")
            read_value_type();
        else if (keyword == "NS_")
            pass_over_symbols();
        else if (keyword == "VERSION" || keyword == "BS_" || keyword == "BU_")
            pass_over_names();
        else if (!is_sign(first, ";"))
            pass_over_statement();
    }

    // A list of the keywords that a file may use. What begins a section is followed by a colon, a
    // string or a number, or, should BS_ and BU_ be missing, stands at the margin and not alone.
    void pass_over_symbols() {
        if (is_sign(peek(), ":")) next();
        const auto begins_section = [](const Token& word, const Token& then) {
            return then.kind != TokenKind::word || is_digit(then.text[0]) ||
                   (word.at_margin && then.line == word.line);
        };
        while (peek().kind == TokenKind::word && !begins_section(peek(), peek(1)))
            next();
    }

    // What no semicolon ends goes on until the next section.
    void pass_over_names() {
        while (peek().kind != TokenKind::end && !is_keyword(peek()))
            next();
    }

    // Keywords stand within a statement too (`CM_ SG_ 5 Speed "..."`), but not at the margin,
    // unless its semicolon is missing.
    void pass_over_statement() {
        while (peek().kind != TokenKind::end && !(peek().at_margin && is_keyword(peek())))
            if (is_sign(next(), ";")) return;
    }

    std::string_view take_word(const char* what) {
        const Token& token = peek();
        if (token.kind != TokenKind::word || is_keyword(token)) fail_at(token, what);
        return next().text;
    }

    std::string take_name(const char* what) {
        const Token& token = peek();
        const std::string_view word = take_word(what);
        if (!is_name(word)) fail_at(token, what);
        return std::string(word);
    }

    void take_sign(const char* sign) {
        if (!is_sign(peek(), sign)) fail_at(peek(), in_quotes(sign));
        next();
    }

    template <class Integer> Integer take_integer(const char* what) {
        const Token& token = peek();
        const std::string_view word = take_word(what);
        Integer value = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || stop != word.data() + word.size()) fail_at(token, what);
        return value;
    }

    double take_number(const char* what) {
        const Token& token = peek();
        const auto value = parse_number(take_word(what));
        if (!value) fail_at(token, what);
        return *value;
    }

    // Some files bound a float by more than a double holds: 4.4E+481.
    double take_limit(const char* what) {
        const Token& token = peek();
        std::string_view word = take_word(what);
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error == std::errc::invalid_argument || stop != word.data() + word.size())
            fail_at(token, what);
        if (error == std::errc()) return value;
        return word.starts_with('-') ? -HUGE_VAL : HUGE_VAL;
    }

    FrameId frame_id(std::uint32_t number) const {
        const bool extended = (number & extended_bit) != 0;
        const FrameId id{number & ~extended_bit, extended};
        if (id.id > (extended ? 0x1fff'ffffu : 0x7ffu))
            fail("identifier " + std::to_string(number) +
                 " is none; expected one of 11 bits (0…2047), or of 29 bits with bit 31 set");
        return id;
    }

    void read_message() {
        form_ = message_form;
        const auto number = take_integer<std::uint32_t>("an identifier");
        DbcMessage message;
        message.line = line_;
        message.name = take_name("the message's name");
        take_sign(":");
        message.bytes = take_integer<int>("the number of bytes");
        pass_over_names(); // the sender
        message_ = &independent_;
        if (number == independent_signals) return;
        message.frame = frame_id(number);
        add(std::move(message));
    }

    void add(DbcMessage&& message) {
        const std::string name = in_quotes(message.name);
        if (message.bytes < 0)
            fail("message " + name + " has " + std::to_string(message.bytes) +
                 " bytes; expected 0 or more");
        const auto [same_id, new_id] = name_of_.emplace(message.frame, message.name);
        if (!new_id) {
            const DbcMessage& other = dbc_.messages.at(same_id->second);
            fail("message " + name + " has the identifier of " + in_quotes(other.name) +
                 " in line " + std::to_string(other.line) + "; expected one of its own");
        }
        const auto [same_name, new_name] = dbc_.messages.emplace(message.name, message);
        if (!new_name)
            fail("message " + name + " is there already, in line " +
                 std::to_string(same_name->second.line) + "; expected another name");
        message_ = &same_name->second;
    }

    void read_signal() {
        form_ = signal_form;
        if (!message_) fail("a signal that belongs to no message; expected a BO_ line before it");
        DbcSignal signal;
        signal.line = line_;
        signal.field.name = take_name("the signal's name");
        signal.field.frame = message_->frame;
        if (!is_sign(peek(), ":")) read_multiplexing(signal);
        take_sign(":");
        read_bits(signal.field);
        read_scale(signal);
        if (peek().kind != TokenKind::string) fail_at(peek(), "the unit in quotes");
        signal.unit = utf8_of(next().text);
        pass_over_names(); // the receivers
        if (message_ != &independent_) add(std::move(signal));
    }

    void read_multiplexing(DbcSignal& signal) {
        const Token& token = peek();
        std::string_view mark = take_word("\":\" or a multiplexer's mark");
        signal.multiplexor = mark.ends_with('M');
        signal.multiplexed = mark.starts_with('m');
        if (mark == "M") return;
        if (signal.multiplexor) mark.remove_suffix(1);
        if (!signal.multiplexed || mark.size() < 2 ||
            !std::all_of(mark.begin() + 1, mark.end(), is_digit))
            fail_at(token, "\":\" or a multiplexer's mark (M, m0, m0M)");
    }

    void read_bits(Field& field) {
        field.start_bit = take_integer<int>("the start bit");
        take_sign("|");
        field.length = take_integer<int>("the number of bits");
        take_sign("@");
        const Token& token = peek();
        std::string order(take_word("the byte order"));
        if (order.size() == 1) order += take_word("+ or -"); // `1 +`
        if (order.size() != 2 || (order[0] != '0' && order[0] != '1') ||
            (order[1] != '+' && order[1] != '-'))
            fail_at(token, "the byte order, 0 or 1 and + or -,");
        field.order = order[0] == '1' ? ByteOrder::little : ByteOrder::big;
        field.kind = order[1] == '+' ? FieldKind::unsigned_integer : FieldKind::signed_integer;
    }

    void read_scale(DbcSignal& signal) {
        take_sign("(");
        signal.field.scale = take_number("the scale");
        take_sign(",");
        signal.field.offset = take_number("the offset");
        take_sign(")");
        take_sign("[");
        signal.minimum = take_limit("the minimum");
        take_sign("|");
        signal.maximum = take_limit("the maximum");
        take_sign("]");
    }

    // Published files have signals that no frame can hold. They are refused where they are asked
    // for.
    static void check_bits(DbcSignal& signal, const DbcMessage& message, long line) {
        signal.fault_line = line;
        signal.fault = message.bytes > longest_message
                           ? "its message of " + std::to_string(message.bytes) +
                                 " bytes comes in several frames; that is not supported"
                           : fault_of(signal.field, message.bytes);
    }

    DbcSignal* find(DbcMessage& message, const std::string& name) const {
        const auto found =
            std::find_if(message.signals.begin(), message.signals.end(),
                         [&](const DbcSignal& signal) { return signal.field.name == name; });
        return found == message.signals.end() ? nullptr : &*found;
    }

    void add(DbcSignal&& signal) {
        check_bits(signal, *message_, line_);
        if (const DbcSignal* other = find(*message_, signal.field.name))
            fail("signal " + in_quotes(signal.field.name) + " is there already, in line " +
                 std::to_string(other->line) + "; expected another name");
        message_->signals.push_back(std::move(signal));
    }

    void read_value_type() {
        form_ = float_form;
        const auto number = take_integer<std::uint32_t>("an identifier");
        const std::string name = take_name("the signal's name");
        if (is_sign(peek(), ":")) next(); // old files have none
        const int type = take_integer<int>("the type (0, 1, 2)");
        pass_over_statement();
        if (number != independent_signals) set_type(frame_id(number), name, type);
    }

    void set_type(FrameId id, const std::string& name, int type) {
        const auto message_name = name_of_.find(id);
        if (message_name == name_of_.end())
            fail(
                "SIG_VALTYPE_ of a message that is not there; expected one of the BO_ lines above");
        DbcMessage& message = dbc_.messages.at(message_name->second);
        DbcSignal* signal = find(message, name);
        if (!signal)
            fail("message " + in_quotes(message.name) + " has no signal " + in_quotes(name) +
                 "; expected one of its SG_ lines");
        if (type < 0 || type > 2)
            fail("type " + std::to_string(type) + "; expected 0 (integer), 1 (float), 2 (double)");
        if (type == 0) return;
        signal->field.kind = type == 1 ? FieldKind::float32 : FieldKind::float64;
        check_bits(*signal, message, line_);
    }

    std::vector<Token> tokens_;
    size_t at_ = 0;
    Dbc dbc_;
    std::map<FrameId, std::string> name_of_;
    DbcMessage independent_;
    DbcMessage* message_ = nullptr; // that SG_ lines belong to; independent_ for those of none
    long line_ = 0;
    std::string form_;
};

} // namespace

Dbc parse_dbc(const std::string& text, const std::string& path) {
    std::string_view rest = text;
    if (rest.starts_with("\xff\xfe") || rest.starts_with("\xfe\xff"))
        throw FileError(path, 0, "is UTF-16 text; save it as UTF-8");
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
    return Parser(rest, path).parse();
}

Dbc read_dbc(const std::string& path) { return parse_dbc(read_file(path), path); }

} // namespace servoid::can
