/// Single-bin correlation of torque and position over a window, with the transient removed.
///
/// Purpose     The fundamental of two channels from running sums. The window need not be a whole
///             number of periods or of samples, and a slow trend (the transient of the start) may
///             lie under it.
/// Formula     y = a cos p + b sin p + c0 + c1 t + c2 t^2 + c3 t^3, by least squares, p the phase
///             of the oscillator and t = -1..1 over the window. Per sample and channel: y times
///             each of [cos, sin, t^2, t^3, 1, t]. The Gram matrix does not depend on data: outside
///             the interrupt the same quantised regressors are replayed and their 21 products
///             summed exactly, in portions. The trend's order is chosen when solving.
///             SID_BIN_PLAIN_DFT is the textbook's a = 2/N sum(y cos p), b = 2/N sum(y sin p),
///             without any of this.
/// Units       Torque Q20 of rated torque, position in counts; both [-2^23 + 1, 2^23 - 1].
///             Regressors Q23, [-2^23, 2^23]. Sums int64_t. Phase Q64 turns.
/// Overflow    A sample beyond its range is clamped and moves its counter. With |y| < 2^23,
///             |regressor| <= 2^23 and N <= 65535 < 2^16 every sum stays below 2^62, so no sum can
///             overflow. The Gram sums likewise: 2^46 N.
/// Errors      sid_bin_start refuses N outside [8, 65535] and a frequency outside (0, half the
///             sample rate). sid_bin_solve returns a status and leaves the coefficients 0 unless it
///             is SID_BIN_OK.
/// Interrupt   sid_bin_step: constant-time, no division, samples outside the window change nothing.
///             The others: background; sid_bin_gram_advance does at most as many samples of work as
///             it is told to.
/// Memory      sizeof(sid_bin_t) = 336 bytes, owned by the caller.
#ifndef SERVOID_SID_BIN_H
#define SERVOID_SID_BIN_H

#include "servoid/sid_osc.h"
#include "servoid/sid_scaled.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SID_BIN_REGRESSORS 6
#define SID_BIN_GRAM_SUMS 21
#define SID_BIN_COUNT_MIN 8U
#define SID_BIN_COUNT_MAX 65535U
/// Largest |torque| and |position| that a bin takes.
#define SID_SAMPLE_LIMIT 8388607

typedef enum {
    SID_BIN_CUBIC = 0, ///< trend of third order
    SID_BIN_QUADRATIC,
    SID_BIN_LINEAR,
    SID_BIN_CONSTANT,
    SID_BIN_PLAIN_DFT ///< the textbook's correlation, to compare with
} sid_bin_method_t;

typedef enum {
    SID_BIN_NOT_RUN = 0,
    SID_BIN_OK,
    SID_BIN_INCOMPLETE,     ///< the window or the replay has not finished
    SID_BIN_SHORT,          ///< less than one period
    SID_BIN_ILL_CONDITIONED ///< the trend and the sine cannot be told apart
} sid_bin_status_t;

/// Where a sum stands: channel 0 is torque, 1 position; regressor r in the order cos, sin, t^2,
///             t^3, 1, t, all Q23
/// (the order that leaves a Cortex-M4 compiler the fewest registers to spill).
#define SID_BIN_SUM(r, channel) (2 * (r) + (channel))
#define SID_BIN_SQUARE(channel) (12 + (channel)) ///< sum of y^2
#define SID_BIN_CROSS 14 ///< sum of torque * position, for eq. (5) as printed
#define SID_BIN_SUMS 15

typedef struct {
    int64_t sums[SID_BIN_SUMS];
    int64_t gram[SID_BIN_GRAM_SUMS];
    uint64_t increment_q64;
    uint64_t phase_q64; ///< of the window's first sample
    int32_t tau_first_q29;
    int32_t tau_step_q29;
    uint32_t count;      ///< samples in the window, N
    uint32_t index;      ///< samples seen, stops at 2^31
    uint32_t gram_index; ///< samples replayed
    uint32_t torque_clamped;
    uint32_t position_clamped;
} sid_bin_t;

/// Fundamental of both channels and what is left of them. Torque in Q20 units, position in counts.
typedef struct {
    sid_scaled_t cosine[2];
    sid_scaled_t sine[2];
    sid_scaled_t residual[2];    ///< sum of squares
    sid_scaled_t smallest_pivot; ///< 1: regressors independent, 0: dependent
    sid_scaled_t
        product_mean; ///< mean(torque * position) of eq. (5), the channels' own means removed
    uint32_t count;
    sid_bin_status_t status;
} sid_bin_result_t;

/// Clears the sums and arms a window of count samples, the first one at phase_q64. False if it
/// cannot be done; then the bin is left with an empty window.
bool sid_bin_start(sid_bin_t* bin, uint64_t increment_q64, uint64_t phase_q64, uint32_t count);

/// One sample. After count calls the window is over and further calls change nothing but index.
void sid_bin_step(sid_bin_t* bin, int32_t torque_pu_q20, int32_t position_count);

/// Replays up to max_samples of the regressors; true when the Gram matrix is complete.
bool sid_bin_gram_advance(sid_bin_t* bin, uint32_t max_samples);

/// Solves from the sums. The sums stay, so that another method can be tried on them.
sid_bin_status_t sid_bin_solve(const sid_bin_t* bin, sid_bin_method_t method,
                               sid_bin_result_t* out);

/// The regressors of one sample of the window, and their accumulation: shared by the interrupt and
/// the replay.
typedef struct {
    int32_t value[SID_BIN_REGRESSORS];
} sid_bin_row_t;

/// The regressors at a phase and a window time.
static inline sid_bin_row_t sid_bin_row(sid_osc_t osc, int32_t tau_q29) {
    const int32_t square_q26 = sid_mulhi(tau_q29, tau_q29);
    sid_bin_row_t row;
    row.value[0] = osc.cosine_q31 >> 8;
    row.value[1] = osc.sine_q31 >> 8;
    row.value[2] = square_q26 >> 3;
    row.value[3] = sid_mulhi(square_q26, tau_q29);
    row.value[4] = 1 << 23;
    row.value[5] = tau_q29 >> 6;
    return row;
}

/// Window time of sample `index`, Q29.
static inline int32_t sid_bin_tau(const sid_bin_t* bin, uint32_t index) {
    return (int32_t)((uint32_t)bin->tau_first_q29 + (uint32_t)bin->tau_step_q29 * index);
}

/// sum[r][channel] += y[channel] * regressor[r] for the regressors a and b; returns what follows in
/// memory. On Arm cores with the DSP extension the same integer arithmetic is written out, because
/// compilers do not load four sums with one instruction by themselves: 23 instead of 45
/// instructions a sample. Define SID_NO_ASM to do without.
#if defined(__GNUC__) && defined(__OPTIMIZE__) && defined(__thumb2__) &&                           \
    defined(__ARM_FEATURE_DSP) && !defined(SID_NO_ASM)
static inline int64_t* sid_bin_add(int64_t* sum, int32_t torque, int32_t position, int32_t a,
                                   int32_t b) {
    __asm__("ldm %0, {r4-r6, r8-r12}\n\t"
            "smlal r4, r5, %2, %4\n\t"
            "smlal r6, r8, %3, %4\n\t"
            "smlal r9, r10, %2, %5\n\t"
            "smlal r11, r12, %3, %5\n\t"
            "stm %0!, {r4-r6, r8-r12}"
            : "=r"(sum)
            : "0"(sum), "r"(torque), "r"(position), "r"(a), "r"(b)
            : "r4", "r5", "r6", "r8", "r9", "r10", "r11", "r12", "memory");
    return sum;
}
static inline void sid_bin_add_squares(int64_t* sum, int32_t torque, int32_t position) {
    __asm__("ldm %0, {r4-r6, r8-r10}\n\t"
            "smlal r4, r5, %1, %1\n\t"
            "smlal r6, r8, %2, %2\n\t"
            "smlal r9, r10, %1, %2\n\t"
            "stm %0, {r4-r6, r8-r10}"
            :
            : "r"(sum), "r"(torque), "r"(position)
            : "r4", "r5", "r6", "r8", "r9", "r10", "memory");
}
#else
static inline int64_t* sid_bin_add(int64_t* sum, int32_t torque, int32_t position, int32_t a,
                                   int32_t b) {
    sum[0] += (int64_t)torque * a;
    sum[1] += (int64_t)position * a;
    sum[2] += (int64_t)torque * b;
    sum[3] += (int64_t)position * b;
    return sum + 4;
}
static inline void sid_bin_add_squares(int64_t* sum, int32_t torque, int32_t position) {
    sum[0] += (int64_t)torque * torque;
    sum[1] += (int64_t)position * position;
    sum[2] += (int64_t)torque * position;
}
#endif

/// All sums of one sample.
static inline void sid_bin_accumulate(sid_bin_t* bin, sid_bin_row_t row, int32_t torque,
                                      int32_t position) {
    int64_t* sum = sid_bin_add(bin->sums, torque, position, row.value[0], row.value[1]);
    sum = sid_bin_add(sum, torque, position, row.value[2], row.value[3]);
    sum = sid_bin_add(sum, torque, position, row.value[4], row.value[5]);
    sid_bin_add_squares(sum, torque, position);
}

#ifdef __cplusplus
}
#endif
#endif
