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

std::vector<double> held_out_power(const Matrix& slopes, const Vector& residual,
                                   const std::vector<int>& block, double ridge) {
    const Vector scale = slopes.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::Index p = slopes.cols();
    std::vector<double> out;
    Matrix gram = Matrix::Zero(p, p);
    Vector moment = Vector::Zero(p);
    struct Part {
        Matrix gram;
        Vector moment;
        double power = 0;
    };
    std::vector<Part> parts;
    for (Eigen::Index row = 0; row < residual.size();) {
        Eigen::Index end = row;
        while (end < residual.size() && block[size_t(end)] == block[size_t(row)])
            ++end;
        const Matrix x = slopes.middleRows(row, end - row) * scale.asDiagonal();
        const Vector r = residual.segment(row, end - row);
        parts.push_back({x.transpose() * x, x.transpose() * r, r.squaredNorm()});
        gram += parts.back().gram, moment += parts.back().moment;
        row = end;
    }
    // A touch of ridge: a block may be the only one that shows a column.
    if (p > 0) ridge *= std::max(1e-300, gram.diagonal().maxCoeff());
    for (const Part& part : parts) {
        Matrix rest = gram - part.gram;
        rest.diagonal().array() += ridge;
        const Vector c = solve_symmetric(rest, Vector(moment - part.moment));
        out.push_back(std::max(0.0, part.power - 2 * c.dot(part.moment) + c.dot(part.gram * c)));
    }
    return out;
}

double peakedness(const Vector& residual) {
    const double n = double(residual.size()), square = residual.squaredNorm() / n;
    return square > 0 ? residual.array().pow(4).sum() / n / (square * square) : 0;
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
