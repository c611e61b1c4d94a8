#include "diagnose/evidence.hpp"

#include "compare/solve.hpp"
#include "compare/spectrum.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace servoid {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

namespace {

// Products of one block's slopes and residuals; of all of them.
struct Block {
    Matrix gram;
    Vector moment;
    double power = 0;
};
struct Blocks {
    std::vector<Block> each;
    Matrix gram;
    Vector moment;
    double ridge = 0;
};

Blocks blocks_of(const Matrix& slopes, const Vector& residual, const std::vector<int>& block,
                 double ridge) {
    const Vector scale = slopes.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::Index p = slopes.cols();
    Blocks out{{}, Matrix::Zero(p, p), Vector::Zero(p), ridge};
    for (Eigen::Index row = 0; row < residual.size();) {
        Eigen::Index end = row;
        while (end < residual.size() && block[size_t(end)] == block[size_t(row)])
            ++end;
        const Matrix x = slopes.middleRows(row, end - row) * scale.asDiagonal();
        const Vector r = residual.segment(row, end - row);
        out.each.push_back({x.transpose() * x, x.transpose() * r, r.squaredNorm()});
        out.gram += out.each.back().gram, out.moment += out.each.back().moment;
        row = end;
    }
    // A touch of ridge: a block may be the only one that shows a column.
    if (p > 0) out.ridge *= std::max(1e-300, out.gram.diagonal().maxCoeff());
    return out;
}

// What the fit to all others would change of the coefficients.
Vector change_without(const Block& part, const Blocks& all) {
    Matrix rest = all.gram - part.gram;
    rest.diagonal().array() += all.ridge;
    return solve_symmetric(rest, Vector(all.moment - part.moment));
}

double power_of(const Block& part, const Vector& c) {
    return std::max(0.0, part.power - 2 * c.dot(part.moment) + c.dot(part.gram * c));
}

} // namespace

std::vector<double> held_out_power(const Matrix& slopes, const Vector& residual,
                                   const std::vector<int>& block, double ridge) {
    const Blocks all = blocks_of(slopes, residual, block, ridge);
    std::vector<double> out;
    for (const Block& part : all.each)
        out.push_back(power_of(part, change_without(part, all)));
    return out;
}

double foreseen_power(const Matrix& slopes, const Vector& residual, const std::vector<int>& block,
                      double ridge) {
    const Blocks all = blocks_of(slopes, residual, block, ridge);
    Matrix gram = all.gram;
    gram.diagonal().array() += all.ridge;
    double out = 0;
    for (const Block& part : all.each) {
        const Vector c = change_without(part, all);
        const Vector along = part.moment - part.gram * c; // X'·e
        out += std::max(0.0, power_of(part, c) - along.dot(solve_symmetric(gram, along)));
    }
    return out;
}

double peakedness(const Vector& residual) {
    const double n = double(residual.size()), square = residual.squaredNorm() / n;
    return square > 0 ? residual.array().pow(4).sum() / n / (square * square) : 0;
}

HeldOut held_out(const FitResult& fit, Assembler& assembler) {
    const Matrix slopes = joint_slopes(fit, assembler);
    const double torque = fit.torque.squaredNorm();
    HeldOut out{held_out_power(slopes, fit.residual, assembler.blocks()),
                std::sqrt(foreseen_power(slopes, fit.residual, assembler.blocks()) / torque)};
    for (double& power : out.blocks)
        power /= torque;
    return out;
}

std::vector<double> held_out_blocks(const FitResult& fit, Assembler& assembler) {
    std::vector<double> power =
        held_out_power(joint_slopes(fit, assembler), fit.residual, assembler.blocks());
    for (double& p : power)
        p /= fit.torque.squaredNorm();
    return power;
}

double error_of(const std::vector<double>& blocks) {
    return std::sqrt(std::accumulate(blocks.begin(), blocks.end(), 0.0));
}

double held_out_error(const FitResult& fit, Assembler& assembler) {
    return error_of(held_out_blocks(fit, assembler));
}

double gain_z(const std::vector<double>& before, const std::vector<double>& after) {
    double gain = 0, square = 0;
    for (size_t i = 0; i < before.size(); ++i)
        gain += before[i] - after[i], square += std::pow(before[i] - after[i], 2);
    const double spread = std::sqrt(std::max(0.0, square - gain * gain / double(before.size())));
    return spread > 0 ? gain / spread : 0;
}

} // namespace servoid
