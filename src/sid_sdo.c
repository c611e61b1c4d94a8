#include "servoid/sid_sdo.h"

#include <string.h>

// Bits of the first byte: command 7..5, unused bytes 3..2, expedited 1, size given 0.
#define COMMAND 0xE0U
#define WRITE_REQUEST 0x20U
#define READ_REQUEST 0x40U
#define ABORT_TRANSFER 0x80U
#define WRITTEN 0x60U
#define EXPEDITED 0x02U
#define SIZE_GIVEN 0x01U

bool sid_sdo_parse(const sid_can_frame_t* request, sid_sdo_t* sdo) {
    const uint32_t first = request->data[0];
    const uint32_t command = first & COMMAND;
    if ((request->length != 8U) || (command == ABORT_TRANSFER)) {
        return false;
    }
    sdo->write = command == WRITE_REQUEST;
    sdo->known = (command == READ_REQUEST) || (sdo->write && ((first & EXPEDITED) != 0U));
    sdo->index = sid_get_u16(&request->data[1]);
    sdo->sub = request->data[3];
    sdo->size = (uint8_t)(((first & SIZE_GIVEN) != 0U) ? 4U - ((first >> 2) & 3U) : 0U);
    sdo->value = sid_get_u32(&request->data[4]);
    if (sdo->size != 0U) {
        sdo->value &= 0xFFFFFFFFU >> (8U * (4U - sdo->size));
    }
    return true;
}

void sid_sdo_answer(const sid_sdo_t* sdo, uint32_t abort_code, sid_can_frame_t* answer) {
    memset(answer->data, 0, sizeof(answer->data));
    answer->fd = false;
    answer->length = 8;
    sid_put_u16(&answer->data[1], sdo->index);
    answer->data[3] = sdo->sub;
    if (abort_code != SID_SDO_OK) {
        answer->data[0] = ABORT_TRANSFER;
        sid_put_u32(&answer->data[4], abort_code);
    } else if (sdo->write) {
        answer->data[0] = WRITTEN;
    } else {
        answer->data[0] =
            (uint8_t)(READ_REQUEST | ((4U - sdo->size) << 2) | EXPEDITED | SIZE_GIVEN);
        sid_put_u32(&answer->data[4], sdo->value);
    }
}
