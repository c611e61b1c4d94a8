// Least squares in long double on [cos, sin, 1, t, t^2, t^3], by Householder reflections: shares
// nothing with the core.
#pragma once

#include "support.hpp"

struct Fit {
    long double cosine = 0, sine = 0, residual = 0;
};

inline Fit reference_fit(const std::vector<int32_t>& y, uint64_t increment, uint64_t phase,
                         int order) {
    const size_t n = y.size(), m = size_t(3 + order);
    std::vector<std::vector<long double>> a(m + 1, std::vector<long double>(n));
    for (size_t i = 0; i < n; i++) {
        const uint64_t p = phase + increment * uint64_t(i);
        const long double angle = 2 * M_PIl * (long double)p / 18446744073709551616.0L;
        const long double t = 2.0L * (long double)i / (long double)(n - 1) - 1;
        a[0][i] = 1;
        for (int k = 1; k <= order; k++)
            a[size_t(k)][i] = a[size_t(k - 1)][i] * t;
        a[m - 2][i] = cosl(angle);
        a[m - 1][i] = sinl(angle);
        a[m][i] = y[i];
    }
    for (size_t c = 0; c < m; c++) {
        long double norm = 0;
        for (size_t i = c; i < n; i++)
            norm += a[c][i] * a[c][i];
        norm = std::copysign(sqrtl(norm), a[c][c]);
        std::vector<long double> v(a[c].begin() + long(c), a[c].end());
        v[0] += norm;
        long double vv = 0;
        for (long double x : v)
            vv += x * x;
        for (size_t k = c; k <= m; k++) {
            long double dot = 0;
            for (size_t i = c; i < n; i++)
                dot += v[i - c] * a[k][i];
            for (size_t i = c; i < n; i++)
                a[k][i] -= 2 * dot / vv * v[i - c];
        }
    }
    Fit out;
    out.sine = a[m][m - 1] / a[m - 1][m - 1];
    out.cosine = (a[m][m - 2] - out.sine * a[m - 1][m - 2]) / a[m - 2][m - 2];
    for (size_t i = m; i < n; i++)
        out.residual += a[m][i] * a[m][i];
    return out;
}

inline double reference_inertia(const Fit& torque, const Fit& position, uint64_t increment) {
    const long double w = 2 * M_PIl * (long double)increment / 18446744073709551616.0L;
    const long double re = torque.cosine * position.cosine + torque.sine * position.sine;
    const long double square = position.cosine * position.cosine + position.sine * position.sine;
    return double(-re / (w * w * square) / 1048576.0L);
}
