#include "compare/lag.hpp"

#include "compare/assembly.hpp"
#include "effects/catalogue.hpp"
#include "effects/direction.hpp"

#include <Eigen/QR>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kLongest_s = 0.05;     // no drive answers later
constexpr double kOfBand = 4;           // periods of the band edge
constexpr double kOfRecord = 1.0 / 6;   // of the record's length
constexpr double kOfPeriod = 0.45;      // of the move's period: half of it is a change of sign
constexpr double kOwnShare = 0.02;      // of the torque's slope that no law makes up
constexpr Eigen::Index kFewestRows = 4; // to a column
constexpr double kSteady = 0.8;         // of sgn v through the band limit: no turn in sight
constexpr int kBands = 24;              // of frequency, for the standard deviation
constexpr int kMostSteps = 12;
constexpr double kSettled = 1e-4;     // of the standard deviation
constexpr double kSettledBand = 1e-7; // of a period of the band edge

double reach_of(const std::vector<PreparedMotion>& motions) {
    double reach = kLongest_s;
    for (const PreparedMotion& m : motions) {
        reach = std::min(
            {reach, kOfBand / m.band_Hz, kOfRecord * double(m.grid.count) * m.grid.step_s});
        if (m.period_s) reach = std::min(reach, kOfPeriod * *m.period_s);
    }
    return reach;
}

// Instants of one capture: on its grid, and among the rows of the assembly.
struct Points {
    std::vector<Eigen::Index> on_grid, rows;
    void add(Eigen::Index k, Eigen::Index row) { on_grid.push_back(k), rows.push_back(row); }
};

// One capture: its torque as the model lets it reach the motor, and the instants that are compared.
struct Recorded {
    const PreparedMotion& motion;
    TorqueSignal signal;
    Matrix plain; // v, 1, sgn v and its slope through the band limit
    Points points;
};

// Instants at which every delay that is tried has a value. Those that see the axis turn are left
// out where that leaves enough: while it sticks, friction is whatever it has to be.
Points points_of(const Recorded& c, double reach_s, Eigen::Index first_row) {
    const PreparedMotion& m = c.motion;
    const TorqueSignal& s = c.signal;
    const double margin = reach_s + m.low_pass->half_length_s() + s.sample_time_s;
    const double first = s.delay_s + margin;
    const double last = double(s.samples.size() - 1) * s.sample_time_s + s.delay_s - margin;
    Points all, steady;
    Eigen::Index row = first_row;
    for (Eigen::Index k = 0; k < m.grid.count; ++k) {
        if (!m.used[size_t(k)]) continue;
        const bool reached = m.grid.at(k) > first && m.grid.at(k) < last;
        if (reached) all.add(k, row);
        if (reached && std::abs(c.plain(k, 2)) > kSteady) steady.add(k, row);
        ++row;
    }
    return 2 * steady.rows.size() > all.rows.size() ? steady : all;
}

// Friction turns late where the axis sticks, and that is no delay of the torque: sgn v has its
// slope beside it.
Matrix plain_laws(const PreparedMotion& m) {
    Matrix laws(m.motion.size(), 3);
    laws << m.motion.velocity, Vector::Ones(m.motion.size()), direction(m.motion);
    Matrix out(m.grid.count, 4);
    out << m.band_limit(laws), m.smooth(m.sliding(laws).col(2), 1);
    return out;
}

Recorded recorded_of(const Model& model, const PreparedMotion& m, double reach_s,
                     Eigen::Index first_row) {
    Recorded out{m, delivered_by(model, m.asked), plain_laws(m), {}};
    out.points = points_of(out, reach_s, first_row);
    return out;
}

// What fits the torque at any delay: the laws of the model and the plain ones, orthonormal.
class Laws {
  public:
    explicit Laws(const Matrix& columns) {
        Matrix scaled = columns;
        for (Eigen::Index i = 0; i < scaled.cols(); ++i)
            scaled.col(i) /= std::max(1e-300, scaled.col(i).norm());
        Eigen::ColPivHouseholderQR<Matrix> qr(scaled);
        qr.setThreshold(1e-6); // laws that stand there twice
        basis_ = qr.householderQ() * Matrix::Identity(scaled.rows(), qr.rank());
    }
    Vector without(const Vector& x) const { return x - basis_ * (basis_.transpose() * x); }

  private:
    Matrix basis_;
};

// Both sides of it: a product of two sums to the product of the signals.
std::vector<std::complex<double>> spectrum_of(const Vector& signal) {
    size_t size = 1;
    while (size < size_t(signal.size()))
        size *= 2;
    std::vector<double> padded(signal.begin(), signal.end());
    padded.resize(size, 0.0);
    std::vector<std::complex<double>> out;
    Eigen::FFT<double> fft;
    fft.fwd(out, padded);
    return out;
}

double length(const std::map<int, double>& scores) {
    double sum = 0;
    for (const auto& [block, score] : scores)
        sum += score * score;
    return std::sqrt(sum);
}

// Standard deviation of slope·left where neighbours in time share their error.
double spread_in_time(const Vector& slope, const Vector& left, const std::vector<int>& block) {
    std::map<int, double> scores;
    for (Eigen::Index i = 0; i < slope.size(); ++i)
        scores[block[size_t(i)]] += slope[i] * left[i];
    return length(scores);
}

// The same where neighbours in frequency do: what a law leaves that is not quite right repeats from
// move to move, so that the blocks of time agree on it. A delay is the same at every frequency.
double spread_in_frequency(const Vector& slope, const Vector& left) {
    const std::vector<std::complex<double>> a = spectrum_of(slope), b = spectrum_of(left);
    double power = 0, seen = 0;
    for (const std::complex<double>& line : a)
        power += std::norm(line);
    std::map<int, double> scores; // of bands that hold the same part of the slope
    for (size_t k = 0; k <= a.size() / 2; ++k) {
        const double sides = k == 0 || 2 * k == a.size() ? 1 : 2;
        seen += sides * std::norm(a[k]);
        const int band = std::min(kBands - 1, int(kBands * seen / power));
        scores[band] += sides * (std::conj(a[k]) * b[k]).real() / double(a.size());
    }
    return length(scores);
}

class LagSearch {
  public:
    LagSearch(const Model& model, const std::vector<PreparedMotion>& motions);
    std::optional<Estimate> find() const;

  private:
    struct Step {
        double by, std;
        bool shown; // the laws leave something of the torque's slope
    };
    enum class Taken { here, a_period_away };
    Vector torque(double delay_s, int derivative, Taken taken = Taken::here) const;
    double error(double delay_s) const { return laws_->without(torque(delay_s, 0)).norm(); }
    double coarse() const;
    Step step_from(double delay_s) const;

    double reach_s_, band_Hz_ = 0;
    std::vector<Recorded> captures_;
    std::vector<int> block_;
    std::optional<Laws> laws_;
};

// Rows of the model's laws with the plain ones beside them.
Matrix with_plain_laws(const Matrix& laws, const std::vector<Recorded>& captures) {
    Eigen::Index count = 0;
    for (const Recorded& c : captures)
        count += Eigen::Index(c.points.rows.size());
    Matrix out(count, laws.cols() + 4);
    Eigen::Index row = 0;
    for (const Recorded& c : captures)
        for (size_t i = 0; i < c.points.rows.size(); ++i, ++row) {
            const Eigen::Index k = c.points.on_grid[i];
            out.row(row).head(laws.cols()) = laws.row(c.points.rows[i]);
            out.row(row).tail(4) = c.plain.row(k);
        }
    return out;
}

LagSearch::LagSearch(const Model& model, const std::vector<PreparedMotion>& motions)
    : reach_s_(reach_of(motions)) {
    Assembler assembler(motions);
    assembler.set_context(model);
    const Assembly assembly = assembler.assemble(model);
    Eigen::Index first = 0;
    for (const PreparedMotion& m : motions) {
        captures_.push_back(recorded_of(model, m, reach_s_, first));
        first += m.used_count();
        band_Hz_ = std::max(band_Hz_, m.band_Hz);
        for (Eigen::Index row : captures_.back().points.rows)
            block_.push_back(assembly.block[size_t(row)]);
    }
    const Matrix columns = with_plain_laws(assembly.columns, captures_);
    if (columns.rows() >= kFewestRows * columns.cols()) laws_.emplace(columns);
}

// The same instant of the next period, or of the one before; the instant itself where nothing
// repeats. The grid has a whole number of points to a period.
Eigen::Index a_period_away(const PreparedMotion& m, Eigen::Index k) {
    if (!m.period_s) return k;
    const auto points = Eigen::Index(std::lround(*m.period_s / m.grid.step_s));
    if (k + points < m.grid.count) return k + points;
    return k >= points ? k - points : k;
}

// The torque that arrives `delay_s` later than recorded, or its slope. Held instants are left out
// of the slope where they are, not where the torque was: it is a difference of two delays.
Vector arriving(const PreparedMotion& motion, TorqueSignal signal, double delay_s, int derivative) {
    signal.delay_s += delay_s;
    if (derivative == 0) return motion.band_limit(signal);
    const double by_s = signal.sample_time_s / 4;
    signal.delay_s -= by_s;
    const Vector earlier = motion.band_limit(signal);
    signal.delay_s += 2 * by_s;
    return (earlier - motion.band_limit(signal)) / (2 * by_s);
}

Vector LagSearch::torque(double delay_s, int derivative, Taken taken) const {
    Vector out(Eigen::Index(block_.size()));
    Eigen::Index row = 0;
    for (const Recorded& c : captures_) {
        const Vector on_grid = arriving(c.motion, c.signal, delay_s, derivative);
        for (Eigen::Index k : c.points.on_grid)
            out[row++] = on_grid[taken == Taken::here ? k : a_period_away(c.motion, k)];
    }
    return out;
}

// The best of delays that are a quarter of a period of the band edge apart.
double LagSearch::coarse() const {
    const double step_s = 1 / (4 * band_Hz_);
    const auto count = int(reach_s_ / step_s);
    double best = 0, least = error(0);
    for (int i = -count; i <= count; ++i)
        if (const double e = error(i * step_s); e < least) least = e, best = i * step_s;
    return best;
}

// Least squares on the slope of the torque. A delay that is too short by δ leaves δ·dT/dt, as far
// as the laws do not take it up. A loop feeds noise back into the torque, whose slope then follows
// the residual: the slope a period away is as good a witness, and knows nothing of this noise
// (instrumental variable).
LagSearch::Step LagSearch::step_from(double delay_s) const {
    const Vector slope = torque(delay_s, 1);
    const Vector own = laws_->without(slope), residual = laws_->without(torque(delay_s, 0));
    const Vector witness = laws_->without(torque(delay_s, 1, Taken::a_period_away));
    const double power = witness.dot(own);
    Step out{0, 0, power > kOwnShare * kOwnShare * slope.squaredNorm()};
    if (!out.shown) return out;
    out.by = witness.dot(residual) / power;
    const Vector left = residual - out.by * own;
    const double spread =
        std::max(spread_in_time(witness, left, block_), spread_in_frequency(witness, left));
    out.std = spread / power;
    return out;
}

std::optional<Estimate> LagSearch::find() const {
    if (!laws_) return std::nullopt;
    double delay_s = coarse();
    for (int i = 0; i < kMostSteps; ++i) {
        const Step step = step_from(delay_s);
        if (!step.shown) return std::nullopt;
        delay_s += step.by;
        if (!(std::abs(delay_s) < reach_s_)) return std::nullopt;
        if (std::abs(step.by) <= std::max(kSettled * step.std, kSettledBand / band_Hz_))
            return Estimate{delay_s, step.std};
    }
    return std::nullopt;
}

} // namespace

std::optional<Estimate> lag_of_torque(const Model& model,
                                      const std::vector<PreparedMotion>& motions) {
    return LagSearch(model, motions).find();
}

} // namespace servoid
