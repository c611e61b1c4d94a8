#include "servoid/sid_bin.h"

#include "sid_real.h"

#include <string.h>

SID_STATIC_ASSERT(sizeof(sid_bin_t) <= 336, bin_fits_its_stated_size);

enum { COS, SIN, SQUARE, CUBE, ONE, TAU, N_REG = SID_BIN_REGRESSORS };

// ---------------------------------------------------------------- window

bool sid_bin_start(sid_bin_t* bin, uint64_t increment_q64, uint64_t phase_q64, uint32_t count) {
    memset(bin, 0, sizeof(*bin));
    const bool good = (count >= SID_BIN_COUNT_MIN) && (count <= SID_BIN_COUNT_MAX) &&
                      (increment_q64 != 0U) && (increment_q64 < ((uint64_t)1 << 63));
    if (good) {
        bin->increment_q64 = increment_q64;
        bin->phase_q64 = phase_q64;
        bin->count = count;
        bin->tau_step_q29 = (int32_t)(((uint32_t)1 << 30) / count);
        bin->tau_first_q29 = -(int32_t)((uint32_t)bin->tau_step_q29 * (count - 1U) / 2U);
    }
    return good;
}

void sid_bin_step(sid_bin_t* bin, int32_t torque_pu_q20, int32_t position_count) {
    const uint32_t index = bin->index;
    const uint32_t inside = (index < bin->count) ? 1U : 0U;
    const int32_t mask = -(int32_t)inside;
    const int32_t torque = sid_clamp(torque_pu_q20, -SID_SAMPLE_LIMIT, SID_SAMPLE_LIMIT);
    const int32_t position = sid_clamp(position_count, -SID_SAMPLE_LIMIT, SID_SAMPLE_LIMIT);
    const sid_osc_t osc = sid_osc_at(bin->phase_q64 + bin->increment_q64 * index);
    const sid_bin_row_t row = sid_bin_row(osc, sid_bin_tau(bin, index));
    sid_bin_accumulate(bin, row, torque & mask, position & mask);
    bin->torque_clamped =
        sid_count(bin->torque_clamped, inside & (torque != torque_pu_q20 ? 1U : 0U));
    bin->position_clamped =
        sid_count(bin->position_clamped, inside & (position != position_count ? 1U : 0U));
    bin->index = sid_count(index, 1U);
}

bool sid_bin_gram_advance(sid_bin_t* bin, uint32_t max_samples) {
    const uint32_t left = bin->count - bin->gram_index;
    const uint32_t end = bin->gram_index + ((left < max_samples) ? left : max_samples);
    for (uint32_t i = bin->gram_index; i < end; i++) {
        const sid_osc_t osc = sid_osc_at(bin->phase_q64 + bin->increment_q64 * i);
        const sid_bin_row_t row = sid_bin_row(osc, sid_bin_tau(bin, i));
        int64_t* sum = bin->gram;
        for (int r = 0; r < N_REG; r++) {
            for (int c = 0; c <= r; c++) {
                *sum++ += (int64_t)row.value[r] * row.value[c];
            }
        }
    }
    bin->gram_index = end;
    return end == bin->count;
}

// ---------------------------------------------------------------- solution

// The normal matrix with the right-hand sides as two more rows, factorised as L D L' in place: L
// below the diagonal, D on it. Unknowns in the order [1, t, .., cos, sin]: the last pivots then say
// how much of the sine the trend leaves, and the last two unknowns need no back-substitution beyond
// themselves.
typedef struct {
    sid_real_t row[N_REG + 2][N_REG];
    int n;
} sid_system_t;

static int regressor_of(int unknown, int n) {
    static const uint8_t trend[4] = {ONE, TAU, SQUARE, CUBE};
    return (unknown < n - 2) ? trend[unknown] : (unknown - (n - 2));
}

// The textbook takes the regressors as orthogonal: N/2, N/2, N on the diagonal, nothing beside it.
static int64_t gram_of(const sid_bin_t* bin, sid_bin_method_t method, int r, int c) {
    const int high = (r > c) ? r : c;
    const int low = (r > c) ? c : r;
    if (method == SID_BIN_PLAIN_DFT) {
        return (low == high) ? (int64_t)bin->count << ((r == ONE) ? 46 : 45) : 0;
    }
    return bin->gram[high * (high + 1) / 2 + low];
}

static void load_system(const sid_bin_t* bin, sid_bin_method_t method, sid_system_t* s) {
    for (int j = 0; j < s->n; j++) {
        const int c = regressor_of(j, s->n);
        for (int i = j; i < s->n; i++) {
            s->row[i][j] = sid_real_make(gram_of(bin, method, regressor_of(i, s->n), c), -46);
        }
        s->row[s->n][j] = sid_real_make(bin->sums[SID_BIN_SUM(c, 0)], -23);
        s->row[s->n + 1][j] = sid_real_make(bin->sums[SID_BIN_SUM(c, 1)], -23);
    }
}

// start - sum of L[i][k] L[j][k] D[k] over k < end
static sid_real_t reduce(const sid_system_t* s, sid_real_t start, int i, int j, int end) {
    for (int k = 0; k < end; k++) {
        const sid_real_t product = sid_real_mul(s->row[i][k], s->row[j][k]);
        start = sid_real_sub(start, sid_real_mul(product, s->row[k][k]));
    }
    return start;
}

// Returns the smallest pivot relative to its diagonal, that is 1 - R^2 of a regressor on those
//             before it.
static sid_real_t factorise(sid_system_t* s) {
    sid_real_t smallest = sid_real_make(1, 0);
    for (int i = 0; i < s->n + 2; i++) {
        for (int j = 0; (j < i) && (j < s->n); j++) {
            s->row[i][j] = sid_real_div(reduce(s, s->row[i][j], i, j, j), s->row[j][j]);
        }
        if (i < s->n) {
            const sid_real_t diagonal = s->row[i][i];
            s->row[i][i] = reduce(s, diagonal, i, i, i);
            const sid_real_t pivot = sid_real_div(s->row[i][i], diagonal);
            smallest = sid_real_less(pivot, smallest) ? pivot : smallest;
        }
    }
    return smallest;
}

static void store(const sid_system_t* s, int channel, int64_t square, sid_bin_result_t* out) {
    const int n = s->n;
    const sid_real_t* const z = s->row[n + channel];
    const sid_real_t coupling = sid_real_mul(s->row[n - 1][n - 2], z[n - 1]);
    const sid_real_t rest = reduce(s, sid_real_make(square, 0), n + channel, n + channel, n);
    sid_real_store(&out->sine[channel], z[n - 1]);
    sid_real_store(&out->cosine[channel], sid_real_sub(z[n - 2], coupling));
    sid_real_store(&out->residual[channel], (rest < 0) ? SID_REAL_ZERO : rest);
}

static void solve_system(const sid_bin_t* bin, sid_bin_method_t method, sid_bin_result_t* out) {
    sid_system_t system;
    system.n = (method == SID_BIN_PLAIN_DFT) ? 3 : (3 + SID_BIN_CONSTANT - (int)method);
    load_system(bin, method, &system);
    const sid_real_t pivot = factorise(&system);
    sid_real_store(&out->smallest_pivot, pivot);
    out->status = SID_BIN_ILL_CONDITIONED;
    if (!sid_real_less(pivot, sid_real_make(1, -10))) {
        store(&system, 0, bin->sums[SID_BIN_SQUARE(0)], out);
        store(&system, 1, bin->sums[SID_BIN_SQUARE(1)], out);
        out->status = SID_BIN_OK;
    }
}

static sid_real_t product_mean(const sid_bin_t* bin) {
    const sid_real_t count = sid_real_make(bin->count, 0);
    const sid_real_t torque = sid_real_make(bin->sums[SID_BIN_SUM(ONE, 0)], -23);
    const sid_real_t position = sid_real_make(bin->sums[SID_BIN_SUM(ONE, 1)], -23);
    const sid_real_t means = sid_real_div(sid_real_mul(torque, position), count);
    const sid_real_t rest = sid_real_sub(sid_real_make(bin->sums[SID_BIN_CROSS], 0), means);
    return sid_real_div(rest, count);
}

// One period, less one sample for the rounding of N.
static bool is_short(const sid_bin_t* bin) {
    const uint64_t turns_q32 = (bin->increment_q64 >> 32) * (bin->count + 1U);
    return turns_q32 + bin->count < ((uint64_t)1 << 32);
}

sid_bin_status_t sid_bin_solve(const sid_bin_t* bin, sid_bin_method_t method,
                               sid_bin_result_t* out) {
    memset(out, 0, sizeof(*out));
    out->count = bin->count;
    if ((bin->count == 0U) || (bin->index < bin->count) ||
        ((method != SID_BIN_PLAIN_DFT) && (bin->gram_index < bin->count))) {
        out->status = SID_BIN_INCOMPLETE;
    } else if (is_short(bin)) {
        out->status = SID_BIN_SHORT;
    } else {
        sid_real_store(&out->product_mean, product_mean(bin));
        solve_system(bin, method, out);
    }
    return out->status;
}
