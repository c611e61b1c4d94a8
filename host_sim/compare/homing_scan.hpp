// How well the captures agree, for every place of their position zeros.
#pragma once

#include "compare/assembly.hpp"

#include <vector>

namespace servoid {

using Offsets = std::vector<double>; // per capture, rad or m

// After how much of the position all waves are back in phase.
double period_of(const std::vector<PositionWave>& waves);
// What an offset has to gain, as a logarithm of the likelihood: one of many places, and most
// encoders are homed.
double price_of_offset(const std::vector<PositionWave>& waves);
// How many independent numbers the residual of one capture holds, capped as in diagnose/weigh.
double independent_numbers(const Eigen::VectorXd& residual);

// The captures as the products of their columns and torque: an offset turns rows and columns of
// those, so that a place costs a few µs whatever the length of the records.
class HomingScan {
  public:
    // The model's shapes as they are; held: its coefficients too, else they are solved for, without
    // their bounds. The assembler is in the context of the model, whatever its homing.
    HomingScan(const Model& model, Assembler& assembler, bool held);

    size_t captures() const { return products_.size(); }
    double price() const { return price_of_offset(waves_); }
    // The products of all captures before `end` but one.
    Eigen::MatrixXd all_but(size_t capture, const Offsets& offsets, size_t end) const;
    // Squared residual of those and the one at a place.
    double power(const Eigen::MatrixXd& others, size_t capture, double place) const;
    // The place of the least, over a period in which all waves are back in phase; of two that are
    // as good the nearer one.
    double best_place(const Eigen::MatrixXd& others, size_t capture) const;
    // Golden section within a step of the scan to each side.
    double refined(const Eigen::MatrixXd& others, size_t capture, double place) const;
    // How many independent numbers the residuals of the captures before `end` hold.
    double count(const Offsets& offsets, size_t end) const;
    // Standard deviation of the first capture's place where the model is held.
    double std_of(double place) const;

  private:
    Eigen::MatrixXd rows(const Eigen::MatrixXd& all, size_t capture) const;
    Eigen::VectorXd residual(size_t capture, double place, const Eigen::VectorXd& c) const;
    Eigen::MatrixXd turned(size_t capture, double place) const;
    Eigen::VectorXd solved(const Eigen::MatrixXd& all) const;

    const Assembler& assembler_;
    std::vector<PositionWave> waves_;
    Eigen::VectorXd values_;
    Assembly assembly_;
    std::vector<int> free_;
    std::vector<Eigen::MatrixXd> products_; // of [columns, torque], a capture each
    int places_ = 0;
    double step_ = 0;
};

} // namespace servoid
