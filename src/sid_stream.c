#include "servoid/sid_stream.h"

#include <string.h>

#define HEADER_BYTES 8U
#define SID_FRAME_REFERENCES 1U

bool sid_stream_init(sid_stream_t* stream, int32_t* references, uint32_t count,
                     const sid_excite_config_t* guards) {
    memset(stream, 0, sizeof(*stream));
    stream->references = references;
    stream->mask = count - 1U;
    return sid_excite_init(&stream->guards, guards) && (references != NULL) && (count >= 16U) &&
           ((count & (count - 1U)) == 0U);
}

bool sid_stream_prepare(sid_stream_t* stream, uint32_t total) {
    if ((stream->running != 0) || (total == 0U) || (total > ((uint32_t)1 << 30))) {
        return false;
    }
    stream->filled = 0;
    stream->played = 0;
    stream->total = total;
    stream->refused = 0;
    return true;
}

// What the frame has beyond the stored references, as far as the ring has room.
static uint32_t new_references(const sid_stream_t* s, uint32_t first, uint32_t count) {
    const uint32_t known = s->filled - first;
    const uint32_t room = s->mask + 1U - (s->filled - s->played);
    const uint32_t missing = s->total - s->filled;
    uint32_t fresh = (known < count) ? count - known : 0U;
    fresh = (fresh < room) ? fresh : room;
    return (fresh < missing) ? fresh : missing;
}

bool sid_stream_receive(sid_stream_t* stream, const sid_can_frame_t* frame) {
    const uint32_t count = frame->data[1];
    const uint32_t first = sid_get_u32(&frame->data[4]);
    const bool whole = (frame->data[0] == SID_FRAME_REFERENCES) && (count >= 1U) &&
                       (count <= SID_STREAM_REFERENCES) &&
                       (frame->length >= HEADER_BYTES + 4U * count);
    const uint32_t fresh = whole ? new_references(stream, first, count) : 0U;
    if (fresh == 0U) {
        stream->refused = sid_count(stream->refused, 1);
        return false;
    }
    const uint8_t* from = &frame->data[HEADER_BYTES + 4U * (stream->filled - first)];
    for (uint32_t i = 0; i < fresh; i++) {
        stream->references[(stream->filled + i) & stream->mask] =
            (int32_t)sid_get_u32(from + 4U * i);
    }
    SID_FENCE();
    stream->filled += fresh;
    return true;
}

bool sid_stream_is_ready(const sid_stream_t* stream) {
    return (stream->total != 0U) &&
           ((stream->filled == stream->total) || (stream->filled > stream->mask / 2U));
}

bool sid_stream_start(sid_stream_t* stream, uint32_t position_raw, uint32_t stuck_limit) {
    if ((stream->running != 0) || (stream->played != 0U) || !sid_stream_is_ready(stream)) {
        return false;
    }
    sid_excite_rebase(&stream->guards, position_raw);
    stream->guards.stuck_limit = stuck_limit;
    stream->reference_q8 = 0;
    stream->starved = 0;
    SID_FENCE();
    stream->running = -1;
    return true;
}

// A reference that stands asks for no movement: the stuck guard begins anew.
void sid_stream_step(sid_stream_t* stream, const sid_sample_t* in, sid_command_t* out) {
    sid_tick_t now;
    sid_excite_guard(&stream->guards, in, &now);
    const uint32_t played = stream->played;
    const int32_t wanted =
        sid_nonzero(stream->total - played) & stream->running & ~(now.trip >> 31);
    const int32_t stored = sid_nonzero(stream->filled - played);
    const int32_t next = sid_select(wanted & stored, stream->references[played & stream->mask],
                                    stream->reference_q8);
    const int32_t moves = sid_nonzero((uint32_t)next ^ (uint32_t)stream->reference_q8);
    stream->guards.impulse &= (uint32_t)(moves | (now.trip >> 31)); // a trip tells by it
    stream->reference_q8 = next;
    stream->played = played + ((uint32_t)(wanted & stored) & 1U);
    stream->starved |= wanted & ~stored;
    now.trip |= wanted & ~stored & INT32_MIN;
    stream->guards.trip = now.trip;
    out->held = now.trip;
    out->reference_q8 = sid_select(now.trip >> 31, sid_shl_wrap(now.position, 8), next);
}

void sid_stream_abort(sid_stream_t* stream) { sid_excite_abort(&stream->guards); }

bool sid_stream_is_over(const sid_stream_t* stream) {
    return (stream->guards.trip < 0) || (stream->played == stream->total);
}

void sid_stream_stop(sid_stream_t* stream) { stream->running = 0; }
