#include "can/frame.hpp"

#include <fmt/format.h>

namespace servoid::can {

std::string to_text(FrameId id) {
    return id.extended ? fmt::format("0x{:08X}x", id.id) : fmt::format("0x{:03X}", id.id);
}

} // namespace servoid::can
