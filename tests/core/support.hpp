// What the tests of the core share: conversions, seeds, and an axis in double precision.
#pragma once

#include "servoid/servoid.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

inline double value(sid_scaled_t s) { return std::ldexp(double(s.mantissa), s.exponent); }
inline sid_scaled_t scaled(double x) {
    int e = 0;
    const double m = std::frexp(x, &e);
    return sid_scaled_make(std::llround(std::ldexp(m, 52)), e - 52);
}

// SERVOID_SEED repeats one run; every test prints what it used.
inline unsigned seed_of(const char* test) {
    const char* given = std::getenv("SERVOID_SEED");
    const unsigned seed = given ? unsigned(std::strtoul(given, nullptr, 10)) : 20070909U;
    std::printf("  %s: SERVOID_SEED=%u\n", test, seed);
    return seed;
}

inline uint64_t increment_of(double frequency_Hz, double rate_Hz = 8000) {
    return sid_phase_increment(uint64_t(std::llround(frequency_Hz * 1e6)),
                               uint64_t(std::llround(rate_Hz * 1e6)));
}

// Rigid axis with viscous and Coulomb friction; torque held over a sample, integrated in small
// steps.
struct Axis {
    double inertia_kgm2 = 0.116e-4;
    double viscous_Nms = 0.75e-4;
    double coulomb_Nm = 6.6e-3;
    double rated_Nm = 0.637;
    int bits = 17;
    double sample_s = 125e-6;
    double angle_rad = 0;
    double speed_rad_s = 0;

    double count_rad() const { return 2 * M_PI / std::ldexp(1.0, bits); }

    void advance(double torque_Nm) {
        const int steps = 50;
        const double h = sample_s / steps;
        for (int i = 0; i < steps; i++) {
            const double drive = torque_Nm - viscous_Nms * speed_rad_s;
            double next = speed_rad_s + h * drive / inertia_kgm2;
            const double friction = h * coulomb_Nm / inertia_kgm2;
            next = (std::fabs(next) <= friction) ? 0 : next - std::copysign(friction, next);
            angle_rad += h * 0.5 * (speed_rad_s + next);
            speed_rad_s = next;
        }
    }
    int64_t count() const { return int64_t(std::floor(angle_rad / count_rad())); }
    uint32_t raw() const { return uint32_t(uint64_t(count())) & uint32_t((1ULL << bits) - 1); }

    // J and D of a result, in SI.
    double inertia_of(sid_scaled_t s) const {
        return value(s) * rated_Nm * sample_s * sample_s / count_rad();
    }
    double viscous_of(sid_scaled_t s) const { return value(s) * rated_Nm * sample_s / count_rad(); }
};

inline Axis system_1(int bits = 17) {
    Axis a;
    a.bits = bits;
    return a;
}
// System 2 without its elasticity: what matters here is the statistics of its motion.
inline Axis system_2(int bits = 17) {
    Axis a;
    a.bits = bits;
    a.inertia_kgm2 = 0.556e-4;
    a.viscous_Nms = 0.96e-3;
    a.coulomb_Nm = 2.1e-2;
    return a;
}

// The controller of the paper's both systems, for this axis' encoder.
inline sid_loop_config_t paper_loop(const Axis& axis) {
    const double speed_gain = 40 * 2 * M_PI * 0.116e-4;
    sid_loop_config_t c{};
    c.position_gain = scaled(40 * axis.sample_s);
    c.speed_gain = scaled(speed_gain / axis.rated_Nm * axis.count_rad() / axis.sample_s);
    c.integral_gain = scaled(axis.sample_s / (4 / (40 * 2 * M_PI)));
    c.torque_limit_pu_q20 = 3 << 20;
    return c;
}
