/// The same samples for every machine, and what the core makes of them, as text.
///
/// Purpose     Samples come from integers alone (a parabola for a sine, a shift register for
///             noise), so that any C99 compiler makes the same ones.
#ifndef SERVOID_TEST_REPLAY_H
#define SERVOID_TEST_REPLAY_H

#include "servoid/servoid.h"

uint32_t replay_random(void);
/// About sin(2 pi phase / 2^32) * 2^15.
int32_t replay_sine(uint32_t phase);

void replay_print(const char* name, int64_t value);
void replay_print_scaled(const char* name, sid_scaled_t value);
void replay_end_line(void);
/// The 15 running sums, the Gram matrix and the counters of a window.
void replay_print_bin(const sid_bin_t* bin);

/// A running checksum over words, so that every sample counts and not every one is printed.
typedef struct {
    uint64_t sum;
} replay_digest_t;
void replay_digest(replay_digest_t* digest, uint32_t word);

/// Sessions fed with samples that a drive may give, and with those it must not.
void replay_sessions(void);
/// Each module by itself, at the ends of its range.
void replay_modules(void);
/// A node with its frames.
void replay_node(void);

#endif
