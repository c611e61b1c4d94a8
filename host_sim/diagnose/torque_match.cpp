#include "diagnose/torque_match.hpp"

#include "compare/linear_fit.hpp"
#include "compare/one_way.hpp"
#include "compare/solve.hpp"
#include "effects/catalogue.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kLongest_s = 0.25;   // delay that is looked for
constexpr double kOfRecord = 1.0 / 6; // the same, of the record's length
constexpr double kOfPeriod = 0.45;    // of the move's period: half of it is a change of sign
constexpr Eigen::Index kMostRows = 6000;
constexpr double kOwnShare = 1e-3; // of a column's length that no other column makes up

// The model with the plain laws that it has not.
Model with_plain_laws(Model model, const MotionView& motion) {
    for (const char* name :
         {"viscous", "coulomb", "constant_torque", "spring", "gravity", "quadratic_drag"}) {
        const Effect& effect = *find_effect(name);
        if (!cannot_add(effect, model).empty() || !effect.cannot_show(motion).empty()) continue;
        EffectTerm term;
        term.name = name;
        for (const ParameterInfo& p : effect.info().parameters)
            term.parameters[p.key] = 0;
        model.effects.push_back(term);
    }
    // Friction that bends before it slides turns late, over whatever way: Dahl's law for several,
    // which together are any hysteresis (Prandtl, Ishlinskii).
    for (double share : {0.05, 0.02, 0.008, 0.003, 0.001}) {
        const double way = share * motion.travel();
        if (!(way > 3 * motion.position_quantum)) continue;
        EffectTerm term;
        term.name = "presliding";
        term.parameters = {{"torque", 1.0}, {"stiffness", 1 / way}};
        model.effects.push_back(term);
    }
    return model;
}

// The acceleration's own derivative, by differences.
Vector slope_of(const MotionView& motion) {
    const Eigen::Index n = motion.size();
    Vector out = Vector::Zero(n);
    if (n > 2)
        out.segment(1, n - 2) =
            (motion.acceleration.tail(n - 2) - motion.acceleration.head(n - 2)) /
            (2 * motion.sample_time_s);
    return out;
}

double reach_of(const std::vector<PreparedMotion>& motions) {
    double reach = kLongest_s;
    for (const PreparedMotion& m : motions) {
        reach = std::min(reach, kOfRecord * double(m.grid.count) * m.grid.step_s);
        if (m.period_s) reach = std::min(reach, kOfPeriod * *m.period_s);
    }
    return reach;
}

} // namespace

TorqueMatch::Part TorqueMatch::part_of(const PreparedMotion& m, const Model& model,
                                       Eigen::Index first_row) const {
    Part part{&m, delivered_by(model, m.asked), m.grid, {}, {}};
    // Every delay sees the same instants: those at which the earliest and the latest have a value.
    const double margin = reach_s_ + m.low_pass->half_length_s() + std::abs(part.asked.delay_s);
    const double last = double(part.asked.samples.size() - 1) * m.asked.sample_time_s - margin;
    const Eigen::Index stride = 1 + m.grid.count / kMostRows;
    Eigen::Index row = first_row;
    for (Eigen::Index k = 0; k < m.grid.count; ++k) {
        if (!m.used[size_t(k)]) continue;
        const bool inside = m.grid.at(k) > margin && m.grid.at(k) < last;
        if (inside && k % stride == 0) part.rows.push_back(row), part.points.push_back(k);
        ++row;
    }
    return part;
}

// Columns that the ones before them do not make up already.
void TorqueMatch::keep_columns(const Assembly& a, bool one_way) {
    Matrix rows(Eigen::Index(block_.size()), a.columns.cols());
    Eigen::Index row = 0;
    for (const Part& part : parts_)
        for (Eigen::Index r : part.rows)
            rows.row(row++) = a.columns.row(r);
    std::vector<int> kept;
    for (int i = 0; i < int(a.columns.cols()); ++i) {
        const Vector column = rows.col(i);
        Vector left = column;
        if (!kept.empty()) {
            const Matrix x = pick(rows, kept);
            left -= x * least_squares(x, column);
        }
        if (!(left.norm() > kOwnShare * column.norm())) continue;
        kept.push_back(i);
        const double bound = a.coefficients[size_t(i)].lower;
        lower_.push_back(i > 0 && one_way ? -INFINITY : bound);
    }
    columns_ = pick(rows, kept);
}

TorqueMatch::TorqueMatch(const Model& believed, Assembler& assembler)
    : reach_s_(reach_of(assembler.motions())) {
    const Model model = with_plain_laws(believed, assembler.views().front());
    assembler.set_context(model);
    const Assembly a = assembler.assemble(model);
    Eigen::Index first = 0;
    for (const PreparedMotion& m : assembler.motions()) {
        parts_.push_back(part_of(m, believed, first));
        first += m.used_count();
        for (Eigen::Index r : parts_.back().rows)
            block_.push_back(a.block[size_t(r)]);
        band_Hz_ = std::max(band_Hz_, m.band_Hz);
    }
    keep_columns(a, moves_one_way(assembler.motions()));
    torque_ = torque_at(0);
    jerk_.resize(torque_.size());
    Eigen::Index row = 0;
    for (const Part& part : parts_) {
        const Vector jerk = part.motion->band_limit(Matrix(slope_of(part.motion->motion)));
        for (Eigen::Index k : part.points)
            jerk_[row++] = jerk[k];
    }
}

Vector TorqueMatch::torque_at(double delay_s) const {
    Vector out(Eigen::Index(block_.size()));
    Eigen::Index row = 0;
    for (const Part& part : parts_) {
        TorqueSignal signal = part.asked;
        signal.delay_s += delay_s;
        const double hold_s = signal.held ? signal.sample_time_s / 2 : 0;
        const Vector samples = part.motion->sliding(signal);
        for (Eigen::Index k : part.points) {
            const Grid one{part.grid.at(k), part.grid.step_s, 1};
            out[row++] = part.motion->low_pass->apply(samples, one, 0, signal.delay_s + hold_s)[0];
        }
    }
    return out;
}

Match TorqueMatch::match(const Reading& reading) const {
    Match out;
    if (torque_.size() < 4 * columns_.cols()) return out;
    const Vector torque =
        reading.sign * (reading.delay_s == 0 ? torque_ : torque_at(reading.delay_s));
    const std::vector<bool> fixed(lower_.size(), false);
    const LinearFit fit = solve({columns_, torque, Vector::Zero(columns_.cols()), fixed, lower_});
    if (!fit.solved) return out;
    out.residual = torque - columns_ * fit.values;
    out.error = out.residual.norm() / std::max(1e-300, torque.norm());
    out.inertia = fit.values[0];
    return out;
}

double TorqueMatch::best_delay_s() const {
    const double step = 1 / (8 * band_Hz_);
    const auto count = long(reach_s_ / step);
    double best = 0, least = match({}).error;
    for (long i = -count; i <= count; ++i) {
        const double error = match({double(i) * step, 1}).error;
        if (error < least) least = error, best = double(i) * step;
    }
    // Halving towards the least of three, down to a thousandth of a period of the band.
    for (double by = step / 2; by > step / 128; by /= 2)
        for (const double tried : {best - by, best + by}) {
            const double error = match({tried, 1}).error;
            if (error < least) least = error, best = tried;
        }
    return best;
}

std::optional<Estimate> TorqueMatch::delay_of_inertia() const {
    Matrix x(columns_.rows(), columns_.cols() + 1);
    x << columns_, jerk_;
    if (condition_of(x) > 1e3) return std::nullopt;
    const Vector values = least_squares(x, torque_);
    const Matrix cov = block_covariance(x, torque_ - x * values, block_);
    const Eigen::Index last = x.cols() - 1;
    if (!(values[0] > 0)) return std::nullopt;
    return Estimate{values[last] / values[0], std::sqrt(cov(last, last)) / values[0]};
}

} // namespace servoid
