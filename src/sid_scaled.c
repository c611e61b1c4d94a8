#include "servoid/sid_scaled.h"

#include "servoid/sid_fixed.h"
#include "sid_real.h"

sid_scaled_t sid_scaled_make(int64_t mantissa, int32_t exponent) {
    sid_scaled_t out;
    sid_real_store(&out, sid_real_make(mantissa, exponent));
    return out;
}

sid_scaled_t sid_scaled_mul(sid_scaled_t a, sid_scaled_t b) {
    sid_scaled_t out;
    sid_real_store(&out, sid_real_mul(sid_real_from_scaled(a), sid_real_from_scaled(b)));
    return out;
}

sid_scaled_t sid_scaled_div(sid_scaled_t a, sid_scaled_t b) {
    sid_scaled_t out;
    sid_real_store(&out, sid_real_div(sid_real_from_scaled(a), sid_real_from_scaled(b)));
    return out;
}

int32_t sid_scaled_to_fixed(sid_scaled_t a, int32_t fraction_bits) {
    return sid_saturate(sid_real_to_int(sid_real_from_scaled(a), fraction_bits));
}
