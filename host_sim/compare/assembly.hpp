// The torque view as a matrix: what a model needs for measured motions, in columns.
#pragma once

#include "compare/homing.hpp"
#include "compare/motion.hpp"
#include "model/model.hpp"

#include <map>
#include <string>
#include <vector>

namespace servoid {

// One coefficient of the regression: the inertia (term −1) or a linear coefficient of an effect.
struct Coefficient {
    int term = -1;
    int index = 0;
    bool fixed = false;
    double lower = 0;
    bool may_vanish = false; // a column of zeros leaves its parameter as it is
};

// What a model needs for one or several captures; rows are the used points of all of them.
struct Assembly {
    Eigen::MatrixXd columns; // rows × coefficients
    Eigen::VectorXd torque;  // rows: what reaches the motor
    std::vector<Coefficient> coefficients;
    std::vector<int> block; // rows: points that belong together, for errors that are correlated
};

// Builds assemblies of models that differ little, one after another: the columns of each term are
// kept by its parameters. One assembler per set of motions; not for two threads at once.
class Assembler {
  public:
    explicit Assembler(const std::vector<PreparedMotion>& motions);

    Assembly assemble(const Model& model);
    const std::vector<PreparedMotion>& motions() const { return motions_; }
    // A torque on the used points that no law is asked to explain (rows: blocks().size()).
    void set_artifact(Eigen::VectorXd artifact) { artifact_ = std::move(artifact); }
    const Eigen::VectorXd& artifact() const { return artifact_; }
    // Where the captures' position zeros lie. The columns that are kept know nothing of it: a wave
    // of the position at another zero is a turn of its two columns.
    void set_homing(Homing homing) { homing_ = std::move(homing); }
    const Homing& homing() const { return homing_; }
    Rows rows_of(size_t capture) const { return rows_[capture]; } // its used points
    // Tells laws that change others (a drift of friction, an inertia that varies) what the rest of
    // the model says now.
    void set_context(const Model& model);
    double asked_norm() { return torque_of(Model{}).norm(); }
    const std::vector<int>& blocks() const { return block_; }
    // The motions as the laws see them in the present context.
    const std::vector<MotionView>& views() const { return views_; }

  private:
    using Columns = std::map<std::string, Eigen::MatrixXd>;
    const Eigen::MatrixXd& columns_of(const EffectTerm& term);
    const Eigen::MatrixXd& inertia_of(const Model& model);
    const Eigen::MatrixXd& torque_of(const Model& model);

    const std::vector<PreparedMotion>& motions_;
    std::vector<MotionView> views_; // the motions with the context of the model
    std::vector<int> block_;
    std::vector<Rows> rows_;
    Eigen::VectorXd artifact_;
    Homing homing_;
    Columns cache_;
    std::string context_;
};

// Values of all linear coefficients of a model, and back.
Eigen::VectorXd coefficient_values(const Model& model);
void set_coefficient_values(Model& model, const Eigen::VectorXd& values);
std::vector<Coefficient> coefficients_of(const Model& model);

// What arrives at the motor of the torque that was asked for.
TorqueSignal delivered_by(const Model& model, TorqueSignal asked);
// The share of its noise, in amplitude, that arrives with it (Effect::noise_passed).
double noise_passed(const Model& model, const std::vector<PreparedMotion>& motions);

// The motion with what the rest of the model says filled in, for laws that change others.
MotionView in_context(const Model& model, MotionView view);

// Friction as `friction_drift` means it: viscous, Coulomb, Stribeck, bristles.
bool is_friction(const std::string& effect);

} // namespace servoid
