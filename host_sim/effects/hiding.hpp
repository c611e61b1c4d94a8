// How an effect is hidden in a drive: its parameters as a function of one number, the strength, the
// rest drawn at random to suit a motion.
#pragma once

#include "effects/effect.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>

namespace servoid {

struct Hiding {
    std::function<EffectTerm(double strength)> at; // empty: not in this motion
    double start = 1;                              // strength to begin with
    double least = 0, most = std::numeric_limits<double>::infinity();
};

// The motion of the axis without the effect, and its friction.
struct Scenery {
    Motion kind = Motion::rotary;
    double lowest = 0, highest = 0;          // position, rad or m
    double top_speed = 0, typical_speed = 0; // rad/s or m/s; typical: rms
    double top_torque = 0;                   // N·m or N, band-limited
    double duration_s = 0, period_s = 0;     // period 0: does not repeat
    double band_Hz = 0;                      // of the torque view
    double viscous = 0, coulomb = 0;         // of the model, mean of both directions
    double travel() const { return highest - lowest; }
    double reach() const { return std::max(std::abs(lowest), std::abs(highest)); }
};

// Random numbers that are the same on every machine: the library's distributions are not.
class Draw {
  public:
    Draw(const Scenery& scenery, std::uint64_t seed, std::uint64_t attempt);

    const Scenery& scenery() const { return scenery_; }
    double uniform(double low, double high);
    double log_uniform(double low, double high);
    int integer(int low, int high); // inclusive
    double sign() { return uniform(0, 1) < 0.5 ? -1 : 1; }
    double phase(); // −π…π

    // A torque that is felt but does not rule.
    double torque() const { return 0.2 * scenery_.top_torque; }
    // Cycles per revolution (whole) or per metre: at least two in the travel, and slow enough that
    // the band keeps them at the usual speed; 0 where there is no such order.
    double order();

  private:
    const Scenery& scenery_;
    std::mt19937_64 engine_;
};

} // namespace servoid
