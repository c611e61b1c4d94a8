/// FDCAN1: 1 Mbit/s, data of CAN FD frames at 5 Mbit/s, three frames deep both ways.
///
/// Purpose     What sid_hal_can_receive and sid_hal_can_send are made of. Nothing waits.
/// Frames      Only what a node listens to is let in: NMT, its requests and references, heartbeats.
///             Remote frames and extended identifiers are refused by the controller.
/// Errors      A frame that came while three were waiting is lost: every protocol of sid_node asks
///             again. After bus off the controller is let back in at the next fdcan_receive.
#ifndef SERVOID_FDCAN_H
#define SERVOID_FDCAN_H

#include "servoid/sid_can.h"

/// Time quanta are cycles of 170 MHz: 170 a bit, sample point 80 %; in the data of an FD frame 34,
/// 79.4 %.
#define FDCAN_NOMINAL_SEG1 135U
#define FDCAN_NOMINAL_SEG2 34U
#define FDCAN_DATA_SEG1                                                                            \
    26U // PORT: a bit has at most 49 quanta; below 3.5 Mbit/s it needs a divider
#define FDCAN_DATA_SEG2 7U

bool fdcan_init(uint32_t node_id);
bool fdcan_receive(sid_can_frame_t* frame);
bool fdcan_send(const sid_can_frame_t* frame);

#endif
