// A capture made ready for the torque view: the motion with its derivatives at the sample rate, and
// the torque that acted on it, band-limited on a coarser grid.
#pragma once

#include "capture/capture.hpp"
#include "compare/held.hpp"
#include "compare/low_pass.hpp"
#include "effects/effect.hpp"

#include <optional>

namespace servoid {

enum class Input { automatic, reference, measured };

// What set the upper edge of the band.
enum class BandLimit { asked, torque, excitation, repetition, noise, record, sample_rate };

struct Band {
    double edge_Hz = 0;
    BandLimit limit = BandLimit::asked;
};

struct MotionOptions {
    std::optional<double> band_Hz; // else chosen from the data
    Input input = Input::automatic;
};

// Times are seconds after the capture's first row.
struct PreparedMotion {
    const Capture* capture = nullptr;
    // At the sample rate, smoothed as little as its noise allows; the acceleration without what the
    // jumps at either end of a held stretch would smear over its neighbours.
    MotionView motion;
    double motion_start_s = 0;
    std::optional<LowPass> low_pass;                  // of the motion's rate, at the band
    Grid grid;                                        // where torque and columns are compared
    Eigen::VectorXd torque;                           // N·m or N on the grid
    Eigen::VectorXd position, velocity, acceleration; // on the grid
    std::vector<bool> used;  // false: standing still, where friction may be anything up to Tc
    std::vector<bool> rests; // of a twin: it stands still where the measured axis does not
    double band_Hz = 0;
    BandLimit band_limited_by = BandLimit::asked;
    double smoothing_Hz = 0;        // band of `motion`
    HeldWeight held_weight;         // where friction holds the axis: no law is asked there
    Eigen::VectorXd held;           // the same on `motion`; empty where it never does
    std::optional<double> period_s; // stated or found
    double position_noise = 0;      // standard deviation per sample, rad or m
    double acceleration_noise = 0;  // of the band-limited acceleration
    double velocity_noise = 0;      // of the band-limited velocity
    double torque_noise = 0;        // of the band-limited torque, from its quantisation
    Input input = Input::reference; // which one was used
    std::string torque_name;        // "torque_ref", "torque"

    TorqueSignal asked; // as recorded, for effects between asked and delivered torque

    // Torques of laws at the sample rate (rows: motion.size()), or samples of a recorded torque,
    // without their held instants.
    Eigen::MatrixXd sliding(const Eigen::MatrixXd& columns) const;
    Eigen::VectorXd sliding(const TorqueSignal& signal) const;
    // The same through the band limit, on the grid. A held torque acts half a sample later.
    Eigen::MatrixXd band_limit(const Eigen::MatrixXd& columns) const;
    Eigen::VectorXd band_limit(const TorqueSignal& signal) const;
    // Any signal of the motion, all of it, or its slope.
    Eigen::VectorXd smooth(const Eigen::VectorXd& signal, int derivative = 0) const;
    Eigen::Index used_count() const;
    Eigen::MatrixXd used_rows(const Eigen::MatrixXd& on_grid) const; // (rows: used_count())
    double used_power(const Eigen::VectorXd& on_grid) const;         // sum of squares of those
};

// The motion and torque of one capture. Throws Refusal where there is too little of either.
PreparedMotion prepare_motion(const Capture& capture, const MotionOptions& options);
// Another capture of the same rows through the very same filters, on the same grid; `used` as
// there, and `rests` where this one should not be used.
PreparedMotion prepare_like(const PreparedMotion& like, const Capture& capture);

// The upper edge of the band in which torque and motion carry information, Hz: below the frequency
// where the noise of the measured position, as torque, reaches a small part of the torque itself,
// and within four times what the reference excites.
Band choose_band(const Capture& capture, Input input, std::optional<double> period_s);

// The torque column that is used, and whether it is a held reference.
struct TorqueChoice {
    const std::vector<double>* values = nullptr;
    bool held = false;
    Input input = Input::reference;
    const char* name = "";
};
TorqueChoice choose_torque(const Capture& capture, Input input);

} // namespace servoid
