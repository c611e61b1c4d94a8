#include "diagnose/evidence.hpp"

#include "compare/spectrum.hpp"

#include <Eigen/Dense>

#include <algorithm>

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
        const Vector c = rest.ldlt().solve(moment - part.moment);
        out.push_back(std::max(0.0, part.power - 2 * c.dot(part.moment) + c.dot(part.gram * c)));
    }
    return out;
}

double effective_count(const Vector& residual) {
    const Spectrum spectrum = power_spectrum(residual, 1);
    const double total = spectrum.power.sum(), square = spectrum.power.squaredNorm();
    if (!(square > 0)) return 1;
    // A periodogram of white noise has Σ²/Σ(²) of half its bins, and the record is half-filled by
    // the window and the padding: four numbers a bin, less a half for the skirt of the window.
    const double count = 2.7 * total * total / square;
    return std::clamp(count, 4.0, double(residual.size()));
}

} // namespace servoid
