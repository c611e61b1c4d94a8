// matio fills what is missing in a damaged file with whatever stands next in it or in memory; such
// numbers would be taken for measured ones.
#include "capture/mat_check.hpp"

#include "common/error.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace servoid {

namespace {

constexpr size_t header_size = 128;
constexpr uint32_t type_matrix = 14, type_compressed = 15;

// A tagged piece of the file.
struct Element {
    uint32_t type = 0;
    size_t data = 0, size = 0, next = 0; // offsets in the file, bytes
};

size_t size_of_type(uint32_t type) {
    switch (type) {
    case 1:
    case 2:
        return 1; // int8, uint8
    case 3:
    case 4:
        return 2; // int16, uint16
    case 5:
    case 6:
    case 7:
        return 4; // int32, uint32, single
    case 9:
    case 12:
    case 13:
        return 8; // double, int64, uint64
    default:
        return 0;
    }
}

class MatCheck {
  public:
    MatCheck(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

    void check() {
        check_header();
        // The mark is "MI" written as a number by the machine that saved the file.
        swapped_ = bytes_[126] != (std::endian::native == std::endian::little ? 'I' : 'M');
        for (size_t at = header_size; at < bytes_.size();) {
            const Element variable = element(at, bytes_.size());
            if (variable.type == type_matrix)
                check_variable(variable);
            else if (variable.type != type_compressed)
                fail("is damaged: it holds an element that is no variable");
            // Compressed variables follow each other without padding.
            at = variable.data + variable.size;
        }
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const { throw FileError(path_, 0, reason); }

    void check_header() const {
        if (bytes_.empty()) fail("is empty; expected a MATLAB level 5 file");
        if (bytes_.size() < header_size) fail("is too short for a MATLAB level 5 file");
        if (bytes_.starts_with("MATLAB 7.3") || bytes_.starts_with("\x89HDF"))
            fail("is a MATLAB 7.3 (HDF5) file; save it with -v6 or -v7");
        const std::string mark = bytes_.substr(124, 4);
        if (mark != std::string("\x00\x01IM", 4) && mark != std::string("\x01\x00MI", 4))
            fail("is not a MATLAB level 5 file");
    }

    uint32_t word(size_t at) const {
        uint32_t value = 0;
        std::memcpy(&value, bytes_.data() + at, sizeof value);
        return swapped_ ? __builtin_bswap32(value) : value;
    }

    // The element at an offset, all of it before `end`. Up to 4 bytes of data share the tag.
    Element element(size_t at, size_t end) const {
        if (at > end || end - at < 8) fail("is cut off or damaged");
        const uint32_t first = word(at);
        if (first >> 16 != 0)
            return {first & 0xffff, at + 4, std::min<size_t>(first >> 16, 4), at + 8};
        const size_t size = word(at + 4);
        if (size > end - at - 8) fail("is cut off or damaged");
        return {first, at + 8, size, at + 8 + (size + 7) / 8 * 8};
    }

    // Flags, dimensions, name, numbers, one after the other.
    void check_variable(const Element& variable) const {
        const size_t end = variable.data + variable.size;
        const Element flags = element(variable.data, end);
        if (flags.size < 8) fail("is damaged: a variable has no class");
        constexpr uint32_t first_numeric = 6, last_numeric = 15;
        const uint32_t klass = word(flags.data) & 0xff;
        if (klass < first_numeric || klass > last_numeric) return; // refused by name later
        const Element dimensions = element(flags.next, end);
        const Element name = element(dimensions.next, end);
        const Element numbers = element(name.next, end);
        const size_t width = size_of_type(numbers.type);
        if (width == 0 || numbers.size != width * count(dimensions))
            fail("is damaged: variable " + in_quotes(bytes_.substr(name.data, name.size)) +
                 " does not hold as many numbers as its dimensions say");
    }

    size_t count(const Element& dimensions) const {
        size_t product = 1;
        for (size_t at = 0; at + 4 <= dimensions.size; at += 4) {
            product *= word(dimensions.data + at);
            if (product > bytes_.size()) return SIZE_MAX / 16; // cannot be there; must not wrap
        }
        return product;
    }

    const std::string& path_;
    const std::string& bytes_;
    bool swapped_ = false;
};

} // namespace

void check_mat_file(const std::string& path, const std::string& bytes) {
    MatCheck(path, bytes).check();
}

} // namespace servoid
