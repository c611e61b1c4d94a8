// How well torque and motion belong together: the torque the other way round, or some time earlier
// or later, against the model and the plain laws that it may lack.
#pragma once

#include "compare/regression.hpp"

#include <optional>
#include <vector>

namespace servoid {

// One way of reading the torque: acting `delay_s` later than recorded, times `sign`.
struct Reading {
    double delay_s = 0;
    int sign = 1;
};

struct Match {
    double error = INFINITY; // ‖T − T̂‖/‖T‖, inertia and dissipation kept ≥ 0
    double inertia = 0;
    Eigen::VectorXd residual;
};

// The columns are those of the model as it is believed, and of viscous and Coulomb friction, a
// constant torque, a spring, gravity and hysteresis where it has none: what is commonly missing is
// not taken for a capture that is wrong. A column that the others make up is left out. Cost: some
// 1e-3 s a match.
class TorqueMatch {
  public:
    TorqueMatch(const Model& model, Assembler& assembler);

    double longest_delay_s() const { return reach_s_; } // either way
    Match match(const Reading& reading) const;

    // The delay with the least error, either way.
    double best_delay_s() const;

    // Torque on the compared instants, read as recorded.
    const Eigen::VectorXd& torque() const { return torque_; }
    const Eigen::MatrixXd& columns() const { return columns_; }
    const std::vector<int>& blocks() const { return block_; }

    // The delay that the inertia's share of the torque alone asks for, and its standard deviation,
    // to first order; nothing where the motion does not show it. Friction that turns late (before
    // it slides, behind a gap) looks like a late torque, but inertia is never late.
    std::optional<Estimate> delay_of_inertia() const;

  private:
    struct Part { // of one capture
        const PreparedMotion* motion;
        TorqueSignal asked; // as the model delivers it
        Grid grid;
        std::vector<Eigen::Index> rows;   // of the assembly
        std::vector<Eigen::Index> points; // of the motion's grid
    };
    Part part_of(const PreparedMotion& motion, const Model& model, Eigen::Index first_row) const;
    void keep_columns(const Assembly& assembly, bool one_way);
    Eigen::VectorXd torque_at(double delay_s) const;

    std::vector<Part> parts_;
    Eigen::MatrixXd columns_;
    std::vector<double> lower_;
    std::vector<int> block_;
    Eigen::VectorXd torque_, jerk_;
    double reach_s_ = 0, band_Hz_ = 0;
};

} // namespace servoid
