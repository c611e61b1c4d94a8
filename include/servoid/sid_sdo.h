/// Expedited SDO transfers of CANopen (CiA 301, 7.2.4): one object of up to four bytes a frame.
///
/// Purpose     The server's side of one request and its answer. What the objects are is the node's
///             (sid_node.h).
/// Frames      Request on 0x600 + node: 0x40 index sub reads; 0x2F, 0x2B, 0x27, 0x23 index sub
///             value writes 1, 2, 3, 4 bytes. Answer on 0x580 + node: 0x4F, 0x4B, 0x47, 0x43 with
///             the value; 0x60 written; 0x80 with an abort code. All of 8 bytes.
/// Errors      sid_sdo_parse returns false for a frame that asks nothing: too short, or an abort by
///             the client. Segmented and block transfers are answered with SID_SDO_COMMAND.
/// Interrupt   No: background. No state between frames.
/// Memory      None.
#ifndef SERVOID_SID_SDO_H
#define SERVOID_SID_SDO_H

#include "servoid/sid_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Abort codes of CiA 301, table 22.
#define SID_SDO_OK 0U
#define SID_SDO_COMMAND 0x05040001U    ///< no such transfer
#define SID_SDO_WRITE_ONLY 0x06010001U ///< read of what can only be written
#define SID_SDO_READ_ONLY 0x06010002U
#define SID_SDO_NO_OBJECT 0x06020000U
#define SID_SDO_LENGTH 0x06070010U ///< another number of bytes than the object has
#define SID_SDO_NO_SUB 0x06090011U
#define SID_SDO_RANGE 0x06090030U ///< value out of range
#define SID_SDO_STATE 0x08000022U ///< not in this state, or another master's

typedef struct {
    bool known; ///< a transfer that can be served
    bool write;
    uint8_t size; ///< bytes, 1..4, 0: not said; of a read: the object's, filled in by the node
    uint8_t sub;
    uint16_t index;
    uint32_t value; ///< unused upper bytes 0
} sid_sdo_t;

/// Reads a request; false if it asks nothing.
bool sid_sdo_parse(const sid_can_frame_t* request, sid_sdo_t* sdo);
/// Fills data, length and fd; the identifier is the caller's.
void sid_sdo_answer(const sid_sdo_t* sdo, uint32_t abort_code, sid_can_frame_t* answer);

#ifdef __cplusplus
}
#endif
#endif
