#include "compare/homing_scan.hpp"

#include "compare/linear_fit.hpp"
#include "compare/solve.hpp"
#include "compare/spectrum.hpp"
#include "effects/wave.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kPrice = 3;    // as a logarithm, beside the places that were looked at
constexpr double kPerCycle = 8; // places in a cycle of the fastest wave
constexpr int kMostPlaces = 4096;
constexpr int kMostPeriods = 32;  // of the slowest wave, until all are back in phase
constexpr double kInPhase = 0.05; // cycles
constexpr double kRidge = 1e-10;  // of columns scaled to length 1
constexpr int kSections = 30;     // of two steps: 1e-6 of one

} // namespace

double period_of(const std::vector<PositionWave>& waves) {
    double slowest = INFINITY;
    for (const PositionWave& wave : waves)
        slowest = std::min(slowest, wave.kappa);
    for (int n = 1; n < kMostPeriods; ++n) {
        const auto in_phase = [&](const PositionWave& wave) {
            const double cycles = n * wave.kappa / slowest;
            return std::abs(cycles - std::round(cycles)) < kInPhase;
        };
        if (std::all_of(waves.begin(), waves.end(), in_phase)) return n * kTurn / slowest;
    }
    return kMostPeriods * kTurn / slowest;
}

namespace {

// Places in a period, so close that no wave slips through.
int places_in(const std::vector<PositionWave>& waves) {
    const double cycles = period_of(waves) * fastest_wave(waves) / kTurn;
    return std::min(kMostPlaces, int(std::ceil(kPerCycle * cycles)));
}

} // namespace

double price_of_offset(const std::vector<PositionWave>& waves) {
    return kPrice + std::log(double(places_in(waves)));
}

double independent_numbers(const Vector& residual) {
    return std::min(kMostCount, effective_count(residual));
}

HomingScan::HomingScan(const Model& model, Assembler& assembler, bool held)
    : assembler_(assembler), waves_(waves_of(model)), values_(coefficient_values(model)) {
    const Homing was = assembler.homing();
    assembler.set_homing({}); // the search turns what is not turned yet
    assembly_ = assembler.assemble(model);
    assembler.set_homing(was);
    for (Eigen::Index i = 0; i < values_.size(); ++i)
        if (!held && !assembly_.coefficients[size_t(i)].fixed) free_.push_back(int(i));
    for (size_t i = 0; i < assembler.motions().size(); ++i) {
        Matrix both(assembler.rows_of(i).count, values_.size() + 1);
        both << rows(assembly_.columns, i), rows(assembly_.torque, i);
        products_.push_back(both.transpose() * both);
    }
    places_ = places_in(waves_);
    step_ = kTurn / fastest_wave(waves_) / kPerCycle;
}

Matrix HomingScan::all_but(size_t capture, const Offsets& offsets, size_t end) const {
    Matrix sum = Matrix::Zero(values_.size() + 1, values_.size() + 1);
    for (size_t i = 0; i < end; ++i)
        if (i != capture) sum += turned(i, offsets[i]);
    return sum;
}

double HomingScan::power(const Matrix& others, size_t capture, double place) const {
    const Matrix all = others + turned(capture, place);
    const Eigen::Index n = values_.size();
    const Vector c = solved(all);
    return all(n, n) - 2 * c.dot(all.col(n).head(n)) + c.dot(all.topLeftCorner(n, n) * c);
}

double HomingScan::best_place(const Matrix& others, size_t capture) const {
    double best = 0, least = INFINITY;
    for (int i = 0; i < places_; ++i) {
        // From 0 outwards: of two that are as good, the nearer one.
        const double place = step_ * double(i % 2 ? (i + 1) / 2 : -(i / 2));
        const double here = power(others, capture, place);
        if (here < least * (1 - 1e-9)) least = here, best = place;
    }
    return refined(others, capture, best);
}

double HomingScan::refined(const Matrix& others, size_t capture, double place) const {
    const double share = (std::sqrt(5.0) - 1) / 2;
    double low = place - step_, high = place + step_;
    for (int i = 0; i < kSections; ++i) {
        const double a = high - share * (high - low), b = low + share * (high - low);
        if (power(others, capture, a) < power(others, capture, b))
            high = b;
        else
            low = a;
    }
    return (low + high) / 2;
}

double HomingScan::count(const Offsets& offsets, size_t end) const {
    const Vector c = solved(all_but(end, offsets, end));
    double sum = 0;
    for (size_t i = 0; i < end; ++i)
        sum += independent_numbers(residual(i, offsets[i], c));
    return sum;
}

double HomingScan::std_of(double place) const {
    Matrix columns = rows(assembly_.columns, 0);
    turn(columns, waves_, place);
    const Matrix slope = offset_slope(columns, waves_, values_);
    return std::sqrt(
        block_covariance(slope, residual(0, place, values_), assembler_.blocks())(0, 0));
}

Matrix HomingScan::rows(const Matrix& all, size_t capture) const {
    const Rows r = assembler_.rows_of(capture);
    return all.middleRows(r.first, r.count);
}

Vector HomingScan::residual(size_t capture, double place, const Vector& c) const {
    Matrix columns = rows(assembly_.columns, capture);
    turn(columns, waves_, place);
    return rows(assembly_.torque, capture) - columns * c;
}

Matrix HomingScan::turned(size_t capture, double place) const {
    Matrix out = products_[capture];
    if (place == 0) return out;
    turn(out, waves_, place);
    out.transposeInPlace();
    turn(out, waves_, place);
    return out;
}

Vector HomingScan::solved(const Matrix& all) const {
    Vector out = values_;
    const auto k = Eigen::Index(free_.size()), n = values_.size();
    if (k == 0) return out;
    for (int i : free_)
        out[i] = 0;
    const Vector moment = all.col(n).head(n) - all.topLeftCorner(n, n) * out;
    Matrix gram(k, k);
    Vector right(k), scale(k);
    for (Eigen::Index i = 0; i < k; ++i)
        scale[i] = 1 / std::sqrt(std::max(1e-300, all(free_[size_t(i)], free_[size_t(i)])));
    for (Eigen::Index i = 0; i < k; ++i) {
        right[i] = scale[i] * moment[free_[size_t(i)]];
        for (Eigen::Index j = 0; j < k; ++j)
            gram(i, j) = scale[i] * scale[j] * all(free_[size_t(i)], free_[size_t(j)]);
    }
    gram.diagonal().array() += kRidge; // a column that nothing shows
    const Vector found = scale.cwiseProduct(solve_symmetric(gram, right));
    for (Eigen::Index i = 0; i < k; ++i)
        out[free_[size_t(i)]] = found[i];
    return out;
}

} // namespace servoid
