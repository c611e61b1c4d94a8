#include "can/error_frame.hpp"

#include <linux/can/error.h>

namespace servoid::can {

Trouble trouble_of(const Frame& frame) {
    Trouble out;
    if (!frame.error) return out;
    out.bus_off = (frame.id & CAN_ERR_BUSOFF) != 0;
    out.restarted = (frame.id & CAN_ERR_RESTARTED) != 0;
    if ((frame.id & CAN_ERR_CRTL) == 0 || frame.length < 2) return out;
    const unsigned state = frame.data[1];
    out.error_passive = (state & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0;
    out.warning = (state & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0;
    out.overflow = (state & CAN_ERR_CRTL_RX_OVERFLOW) != 0;
    return out;
}

} // namespace servoid::can
