// Between the host's frames and the core's.
#pragma once

#include "can/frame.hpp"
#include "servoid/sid_can.h"

namespace servoid {

inline can::Frame from_core(const sid_can_frame_t& frame) {
    can::Frame out;
    out.id = frame.id, out.length = frame.length, out.fd = frame.fd;
    out.fd_flags = frame.fd ? 1 : 0; // bit rate switch
    std::copy(frame.data, frame.data + frame.length, out.data.begin());
    return out;
}

// False for what the core does not know: 29 bits, remote and error frames.
inline bool to_core(const can::Frame& frame, sid_can_frame_t& out) {
    out = {};
    out.id = frame.id, out.length = frame.length, out.fd = frame.fd;
    std::copy(frame.data.begin(), frame.data.end(), out.data);
    return !frame.extended && !frame.remote && !frame.error;
}

} // namespace servoid
