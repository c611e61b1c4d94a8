// Prints what the core makes of samples that every machine makes the same: to be compared, bit for
// bit, between processors, compilers and optimisations.
#include "replay.h"

#include "board.h"

uint32_t replay_random(void) {
    static uint32_t state = 2463534242U;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

int32_t replay_sine(uint32_t phase) {
    const int32_t x = (int32_t)phase >> 16; // half turns, Q15
    const int32_t size = (x < 0) ? -x : x;
    return (x * (32768 - size)) >> 13;
}

void replay_print(const char* name, int64_t value) {
    board_print(" ");
    board_print(name);
    board_print(" ");
    board_print_int(value);
}

void replay_print_scaled(const char* name, sid_scaled_t value) {
    replay_print(name, value.mantissa);
    board_print("p");
    board_print_int(value.exponent);
}

void replay_end_line(void) { board_print("\n"); }

void replay_print_bin(const sid_bin_t* bin) {
    for (int i = 0; i < SID_BIN_SUMS; i++) {
        replay_print((i == 0) ? "sums" : "", bin->sums[i]);
    }
    replay_end_line();
    for (int i = 0; i < SID_BIN_GRAM_SUMS; i++) {
        replay_print((i == 0) ? "gram" : "", bin->gram[i]);
    }
    replay_end_line();
    replay_print("index", bin->index);
    replay_print("replayed", bin->gram_index);
    replay_print("torque clamped", bin->torque_clamped);
    replay_print("position clamped", bin->position_clamped);
    replay_end_line();
}

// FNV-1a over the bytes of a word.
void replay_digest(replay_digest_t* digest, uint32_t word) {
    for (uint32_t i = 0; i < 4U; i++) {
        digest->sum = (digest->sum ^ ((word >> (8U * i)) & 0xFFU)) * 0x100000001B3U;
    }
}

int main(void) {
    replay_sessions();
    replay_modules();
    replay_node();
    board_print("end\n");
    return 0;
}
