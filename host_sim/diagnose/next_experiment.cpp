#include "diagnose/next_experiment.hpp"

#include "diagnose/diagnose.hpp"
#include "diagnose/move_menu.hpp"
#include "diagnose/separation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace servoid {

namespace {

constexpr double kRivals = 0.05; // probability from which a candidate is one
constexpr size_t kMostRivals = 4;
constexpr size_t kTries = 5;         // of the effort that keeps a move within its limits
constexpr double kWellUsed = 0.6;    // of a limit: no more effort is tried
constexpr size_t kFinalists = 4;     // moves whose rivals are searched for anew, or a few more
constexpr size_t kFits = 24;         // among finalists, in all
constexpr size_t kMostRows = 700000; // times models fitted to them, in all
constexpr double kClearly = 1.1;     // times better: else the gentler move is taken
constexpr double kNone = 0.05;       // of the noise: how much less does not matter
constexpr double kPlenty = 2.5;      // beyond doubt, were the noise thrice as much: gentle will do

struct Proposal {
    std::string text;
    double bound; // of its separation, from above
};

std::string reason_of(const Separation& s, const Rivalry& rivalry) {
    const std::string unit = unit_of(Quantity::torque, rivalry.base.motion, rivalry.ampere);
    return fmt::format("{} and {} then differ by {:.2g} times the noise of {:.2g} {} up to {:.3g} "
                       "Hz, each fitted to what the other would give, most in: {}",
                       rivalry.name_of(s.truth), rivalry.name_of(s.fitted), s.value, s.noise, unit,
                       s.band_Hz, s.where);
}

struct Feasible {
    std::string text;
    Capture record; // of the best rival
};

// The next effort to try, from the last two: what a limit is used for is friction and weight, which
// stay, and acceleration, which does not.
double next_effort(const std::vector<std::pair<double, double>>& tried) {
    const auto [effort, use] = tried.back();
    double slope = use / effort;
    if (tried.size() > 1) {
        const auto [before, used] = tried[tried.size() - 2];
        if ((use - used) / (effort - before) > 0) slope = (use - used) / (effort - before);
    }
    return std::clamp(effort + (0.9 - use) / slope, 0.1 * effort, 100 * effort);
}

// With as much effort as keeps the best rival within all limits.
std::optional<Feasible> within_limits(const Move& move, const Rivalry& r) {
    std::vector<std::pair<double, double>> tried; // effort, the most used of any limit
    std::optional<Feasible> out;
    double effort = 1;
    while (tried.size() < kTries) {
        const std::optional<std::string> text = text_of(move, effort, r.limits);
        if (!text) break;
        Capture record = record_of(r.rivals.front(), parse_experiment(*text), r.limits);
        const double use = use_of(record, r.limits).most();
        tried.emplace_back(effort, use);
        if (use < 1) out = Feasible{*text, std::move(record)};
        const bool enough = effort >= move.most_effort || use > kWellUsed;
        if (use < 1 ? enough : out.has_value()) break;
        effort = std::min(move.most_effort, next_effort(tried));
    }
    return out;
}

// The choice so far. What it may cost is bounded in numbers, not in time: the same data get the
// same answer.
class Choice {
  public:
    explicit Choice(const Rivalry& rivalry) : rivalry_(rivalry) {}
    // Whether a move separates so well that nothing harder is needed, or enough has been tried.
    bool decided() const { return (best_ && best_->separation >= kPlenty) || rows_ > kMostRows; }

    void consider(const Move& move) {
        std::optional<Feasible> f = within_limits(move, rivalry_);
        if (!f) return;
        rows_ += f->record.rows() * (1 + rivalry_.rivals.size());
        const Proposal proposal{f->text, screen(rivalry_, f->text, std::move(f->record), least())};
        if (proposal.bound >= kPlenty && fits_left_ > 0) return search(proposal);
        const auto after = std::find_if(open_.begin(), open_.end(), [&](const Proposal& p) {
            return p.bound < proposal.bound;
        });
        open_.insert(after, proposal);
    }

    std::optional<NextExperiment> best() {
        for (const Proposal& p : open_)
            if (fits_left_ > 0 && (!best_ || p.bound > kClearly * best_->separation)) search(p);
        return best_;
    }

  private:
    // What a move has to reach to be searched for one day.
    double least() const {
        const double found = best_ ? best_->separation : 0;
        return open_.size() < kFinalists ? found : std::max(found, open_[kFinalists - 1].bound);
    }
    void search(const Proposal& p) try {
        const double least = std::max(kNone, best_ ? kClearly * best_->separation : 0);
        const Separation s = separation(rivalry_, p.text, least);
        fits_left_ -= std::min(fits_left_, s.fits);
        if (s.value > least || !best_)
            best_ = NextExperiment{p.text, reason_of(s, rivalry_), s.value};
    } catch (const Refusal&) { // one of the rivals cannot make it
        fits_left_ -= std::min(fits_left_, rivalry_.rivals.size());
    }

    const Rivalry& rivalry_;
    std::vector<Proposal> open_; // best first, the gentler of equals first
    std::optional<NextExperiment> best_;
    size_t fits_left_ = kFits, rows_ = 0;
};

} // namespace

std::optional<NextExperiment> next_experiment(const std::vector<Model>& rivals,
                                              const std::vector<PreparedMotion>& motions,
                                              double noise, const MoveLimits& limits) {
    const size_t count = std::min(kMostRivals, rivals.size());
    if (count < 2 || motions.empty() || !(limits.travel() > 0)) return std::nullopt;
    const Rivalry rivalry({rivals.begin(), rivals.begin() + long(count)}, motions, noise, limits);
    Choice choice(rivalry);
    for (const Move& move : menu_of(limits, rivals.front().inertia)) {
        if (choice.decided()) break;
        try {
            choice.consider(move);
        } catch (const Refusal&) {    // this move shows nothing
        } catch (const UsageError&) { // or the model's loop cannot make it
        }
    }
    return choice.best();
}

std::optional<NextExperiment> next_experiment(const std::vector<Model>& rivals,
                                              const std::vector<PreparedMotion>& motions,
                                              double noise) {
    if (rivals.empty() || motions.empty()) return std::nullopt;
    return next_experiment(rivals, motions, noise, limits_of(rivals.front(), motions));
}

std::optional<NextExperiment> next_of(const Diagnosis& d,
                                      const std::vector<PreparedMotion>& motions) {
    if (d.verdict != Verdict::ambiguous || d.candidates.empty()) return std::nullopt;
    std::vector<Model> rivals;
    std::vector<std::string> names;
    double none = 1;
    for (const Candidate& c : d.candidates) {
        none -= c.probability;
        const bool richer = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
            return is_richer_form(c.effect, name);
        });
        if (!c.sound || c.probability < kRivals || richer) continue;
        rivals.push_back(c.fit.model), names.push_back(c.effect);
    }
    if (none > kRivals) rivals.push_back(d.before.model);
    const Eigen::VectorXd& left = d.candidates.front().fit.residual;
    return next_experiment(rivals, motions, left.norm() / std::sqrt(double(left.size())));
}

} // namespace servoid
