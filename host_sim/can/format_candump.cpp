#include "can/candump.hpp"

#include <fmt/format.h>

namespace servoid::can {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

std::string format_id(const Frame& frame) {
    if (frame.error) return fmt::format("{:08X}#", frame.id | error_flag);
    return fmt::format(fmt::runtime(frame.extended ? "{:08X}#" : "{:03X}#"), frame.id);
}

std::string format_data(const Frame& frame) {
    std::string text;
    for (size_t i = 0; i < frame.length; ++i)
        text += fmt::format("{:02X}", frame.data[i]);
    return text;
}

std::string format_time(std::int64_t time_ns) {
    const std::int64_t seconds = time_ns / second_ns, fraction = time_ns % second_ns;
    if (fraction % 1000 != 0) return fmt::format("({:010}.{:09})", seconds, fraction);
    return fmt::format("({:010}.{:06})", seconds, fraction / 1000);
}

} // namespace

std::string format_candump(const Frame& frame, const std::string& interface) {
    std::string text = format_time(frame.time_ns) + " " + interface + " " + format_id(frame);
    if (frame.remote) // a length of 0 is left out
        return text + "R" + (frame.length > 0 ? std::to_string(frame.length) : "");
    if (frame.fd) text += fmt::format("#{:X}", frame.fd_flags);
    return text + format_data(frame);
}

} // namespace servoid::can
