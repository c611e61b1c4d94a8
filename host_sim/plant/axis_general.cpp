// The engine for every effect: Cash and Karp's Runge-Kutta pair of orders 4 and 5 between events.
//
// Each period is at least `substeps` steps; a step whose two orders differ by more than the
// tolerance is halved, so that stops, springs and resonances of any stiffness set their own step.
// An event is located by regula falsi on the step's length, the step being repeated each time.
#include "plant/axis_body.hpp"
#include "plant/axis_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace servoid {

namespace {

constexpr double kShortest = 1.0 / 256;        // of a period: below this only a gross error counts,
constexpr double kGross = 3e-3;                // of the velocity: an unstable step's
constexpr double kShortestStable = 0x1p-20;    // and below this none,
constexpr int kManyAttempts = 2000;            // nor after so many in a period: a law that jumps
constexpr double kShortestEvent = 1.0 / 65536; // what leaves a mode within this, leaves it at once
constexpr int kManyEvents = 100;               // in a period: from here on no finer than kShortest
constexpr double kMemory = 0.999; // of the speed that errors are measured by, per period

// Cash, Karp, ACM Trans. Math. Software 16 (1990) 201.
constexpr std::array<double, 6> kNode{0, 1. / 5, 3. / 10, 3. / 5, 1, 7. / 8};
constexpr double kStage[6][5] = {
    {},
    {1. / 5},
    {3. / 40, 9. / 40},
    {3. / 10, -9. / 10, 6. / 5},
    {-11. / 54, 5. / 2, -70. / 27, 35. / 27},
    {1631. / 55296, 175. / 512, 575. / 13824, 44275. / 110592, 253. / 4096}};
constexpr std::array<double, 6> kFifth{37. / 378, 0, 250. / 621, 125. / 594, 0, 512. / 1771};
constexpr std::array<double, 6> kFourth{2825. / 27648, 0,     18575. / 48384, 13525. / 55296,
                                        277. / 14336,  1. / 4};

void add(BodyState& to, double factor, const BodyState& s) {
    to.x += factor * s.x, to.v += factor * s.v, to.p += factor * s.p, to.w += factor * s.w;
}

class GeneralEngine : public Axis::Engine {
  public:
    GeneralEngine(const AxisDescription& axis, double step_s, const GeneralOptions& options)
        : body_(axis, step_s), step_s_(step_s), tolerance_(options.tolerance),
          // The ripple is a parabola over each step: that alone asks for shorter ones.
          longest_(step_s / (options.substeps * (body_.chain.remembers_motion() ? 2 : 1))),
          step_(longest_) {
        body_.reset(y_, position, velocity);
        stuck = body_.stuck();
    }

    void step(double torque) override {
        body_.begin_period(torque);
        events_ = attempts_ = 0;
        scale_ *= kMemory;
        const double arrival = body_.chain.arrival();
        if (arrival > 0) run(0, arrival);
        run(arrival, step_s_);
        position = y_.x, velocity = y_.v;
        stuck = body_.stuck();
    }

    void reset() override {
        body_.reset(y_, position, velocity);
        stuck = body_.stuck();
        scale_ = 1e-300;
    }

  private:
    struct Trial {
        BodyState end;
        double length = 0, margin = 0;      // margin: of the mode at the end
        bool refine = false, gross = false; // worth a shorter step; unstable
    };

    void run(double at, double end) {
        while (at < end) {
            if (attempts_ >= kManyAttempts) step_ = std::max(step_, kShortest * step_s_);
            const bool last = at + 1.001 * step_ >= end;
            const double length = last ? end - at : step_;
            const double done = advance(at, length);
            at = last && done == length ? end : at + done;
        }
    }

    // Predicted from the beginning of the step, or with its end known.
    static Stretch stretch(double at, double h, const BodyState& y, const BodyState& slope) {
        return {
            at, h, {y.x, y.x + h / 2 * (y.v + h / 4 * slope.v), y.x + h * (y.v + h / 2 * slope.v)}};
    }
    static Stretch stretch(double at, double h, const BodyState& y, const Trial& trial) {
        const BodyState& z = trial.end;
        return {at, h, {y.x, (y.x + z.x) / 2 + h / 8 * (y.v - z.v), z.x}};
    }

    // One step of at most this length, to an event or without one; returns how long it was.
    double advance(double at, double length) {
        body_.chain.open(stretch(at, length, y_, BodyState{}));
        body_.enter_mode(at, y_);
        slope_ = body_.slope(at, y_);
        BodyState jerk{};
        add(jerk, length, slope_);
        scale_ = std::max({scale_, std::abs(y_.v), body_.velocity_of(jerk)});
        margin_ = body_.margin(at, y_, slope_);
        Trial trial = settle_length(at, length);
        const bool event = trial.margin < 0;
        if (event && ++events_ <= kManyEvents && margin_ > 0) trial = locate(at, trial);
        const Stretch real = stretch(at, trial.length, y_, trial);
        y_ = trial.end;
        if (event) body_.leave_mode(at + trial.length, y_);
        body_.chain.close(real);
        return trial.length;
    }

    // Halves the step until its error is small enough, and where it begins at the border of its
    // mode until it ends inside: an event is then looked for by a later step.
    Trial settle_length(double at, double length) {
        const bool hurried = events_ >= kManyEvents;
        const double shortest = kShortest * step_s_,
                     shortest_event = hurried ? shortest : kShortestEvent * step_s_;
        bool halved = false;
        for (;; length /= 2) {
            const Trial trial = attempt(at, length);
            const bool unstable = trial.gross && attempts_ < kManyAttempts;
            if (trial.refine && length > (unstable ? kShortestStable * step_s_ : shortest)) {
                step_ = length / 2;
                halved = true;
                continue;
            }
            const bool event = trial.margin < 0;
            const bool at_border = event && (hurried || margin_ <= 0);
            if (at_border && length > shortest_event) continue;
            if (!halved && !event && easy_) step_ = std::min(2 * step_, longest_);
            return trial;
        }
    }

    Trial attempt(double at, double h) {
        ++attempts_;
        if (body_.chain.remembers_motion())
            body_.chain.open(stretch(at, h, y_, slope_));
        else
            body_.chain.open({at, h, {}});
        std::array<BodyState, 6> k;
        k[0] = slope_;
        std::array<double, 6> margin{margin_};
        for (size_t i = 1; i < 6; ++i) {
            BodyState y = y_;
            for (size_t j = 0; j < i; ++j)
                add(y, h * kStage[i][j], k[j]);
            k[i] = body_.slope(at + kNode[i] * h, y);
            if (i == 2 || i == 3) margin[i] = body_.margin(at + kNode[i] * h, y, k[i]);
        }
        Trial out{y_, h};
        BodyState error;
        for (size_t i = 0; i < 6; ++i) {
            add(out.end, h * kFifth[i], k[i]);
            add(error, h * (kFifth[i] - kFourth[i]), k[i]);
        }
        const double e = body_.velocity_of(error) / scale_;
        easy_ = e < tolerance_ / 128;
        // Written so that a step gone to NaN is refined, too.
        out.refine = !(e <= tolerance_);
        out.gross = !(e <= kGross);
        out.margin = body_.margin(at + h, out.end);
        // Left and entered again on the way?
        if (out.margin >= 0)
            out.refine |= dips({0, kNode[2], kNode[3]}, {margin[0], margin[2], margin[3]}) ||
                          dips({kNode[2], kNode[3], 1}, {margin[2], margin[3], out.margin});
        return out;
    }

    // Does the parabola through three points fall below zero between them?
    static bool dips(const std::array<double, 3>& t, const std::array<double, 3>& m) {
        if (m[1] < 0) return true;
        const double left = (m[1] - m[0]) / (t[1] - t[0]), right = (m[2] - m[1]) / (t[2] - t[1]);
        const double bend = (right - left) / (t[2] - t[0]);
        const double middle = right - bend * (t[2] - t[1]); // slope at t[1]
        if (!(bend > 0)) return false;
        const double lowest = t[1] - middle / (2 * bend);
        return lowest > t[0] && lowest < t[2] && m[1] - middle * middle / (4 * bend) < 0;
    }

    // Regula falsi (Illinois) on the length; ends just behind the border.
    Trial locate(double at, const Trial& far) {
        double near = 0, near_margin = margin_, far_margin = far.margin;
        Trial best = far;
        const double enough = 1e-13 * (near_margin - far_margin);
        double least = 5e-12 * far.length;
        int side = 0;
        for (int i = 0; i < 60; ++i) {
            if (best.margin > -enough || best.length - near < 1e-11 * far.length) break;
            const double share = near_margin / (near_margin - far_margin);
            // From a margin of exactly zero no share leads on.
            const double by = std::max(share * (best.length - near), least);
            const Trial trial = attempt(at, std::min(near + by, (near + 3 * best.length) / 4));
            if (trial.margin < 0) {
                best = trial, far_margin = trial.margin;
                if (side < 0) near_margin /= 2;
                side = -1;
            } else {
                near = trial.length, near_margin = trial.margin;
                if (side > 0) far_margin /= 2, least *= 2;
                side = 1;
            }
        }
        // The torque's memory is to be that of the step that was kept.
        return attempt(at, best.length);
    }

    Body body_;
    double step_s_, tolerance_, longest_, step_;
    double scale_ = 1e-300;         // the speed that errors are measured by
    int events_ = 0, attempts_ = 0; // of this period
    double margin_ = 0;             // where the step begins
    bool easy_ = false;             // the last attempt could have been longer
    BodyState y_, slope_;
};

} // namespace

std::unique_ptr<Axis::Engine> make_general_engine(const AxisDescription& axis, double step_s,
                                                  const GeneralOptions& options) {
    return std::make_unique<GeneralEngine>(axis, step_s, options);
}

} // namespace servoid
