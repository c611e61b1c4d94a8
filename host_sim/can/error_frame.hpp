// What the bus says of itself in an error frame.
#pragma once

#include "can/frame.hpp"

namespace servoid::can {

// Of one frame; a frame may say several (linux/can/error.h).
struct Trouble {
    bool bus_off = false;       // the controller has left the bus
    bool restarted = false;     // and has come back
    bool error_passive = false; // 128 errors counted, receiving or sending
    bool warning = false;       // 96 of them
    bool overflow = false;      // the controller lost a frame that it received
};

// All false where the frame is no error frame, or one of another kind.
Trouble trouble_of(const Frame& frame);

} // namespace servoid::can
