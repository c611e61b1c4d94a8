// What a fit cannot answer, said before or after it.
#pragma once

#include "compare/motion.hpp"
#include "model/model.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace servoid {

// On one-way motion Coulomb friction and a constant torque are the same thing.
void refuse_one_way(const Model& model, const std::vector<PreparedMotion>& motions);

// A shape parameter of a fitted model.
struct FittedShape {
    const Model& model;
    size_t term;
    const std::string& key;
};

// A law of the user's may hold shapes that nothing determines (a·b·v), or that have no neighbours
// (θ^n). `slopes`: how the torque moves with everything that was fitted; `column`: with this shape.
void refuse_if_undetermined(const FittedShape& shape, const Eigen::MatrixXd& slopes,
                            Eigen::Index column);

} // namespace servoid
