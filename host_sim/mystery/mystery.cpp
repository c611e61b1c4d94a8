#include "mystery/mystery.hpp"

#include "common/error.hpp"
#include "effects/catalogue.hpp"
#include "mystery/strength.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace servoid {

namespace {

constexpr unsigned long kTuningNoise = 1; // the secret does not depend on the noise of the capture
constexpr int kDraws = 2;                 // of an effect's parameters, before the next effect
constexpr int kSteps = 10;                // of the search for a strength
// Aimed at inside the range, so that another noise does not lead out of it.
constexpr double kLeastAim = 0.06, kMostAim = 0.24, kNear = 1.15;
constexpr double kOverFloor = 1.0; // an effect below what is left anyway is not shown
constexpr double kUnnamed = 0.5;   // of the share: more, and the effect's own fit would not find it

std::vector<const Effect*> candidates(const Model& model) {
    std::vector<const Effect*> out;
    for (const Effect* effect : catalogue())
        if (!model.find(effect->info().name) && cannot_add(*effect, model).empty())
            out.push_back(effect);
    return out;
}

template <class T> void shuffle(std::vector<T>& items, Draw& draw) {
    for (size_t i = items.size(); i > 1; --i)
        std::swap(items[i - 1], items[size_t(draw.integer(0, int(i) - 1))]);
}

bool is_shown(const Strength& s) {
    return s.share > kOverFloor * s.floor && s.unnamed < kUnnamed * s.share;
}

// A strength and what it leaves.
struct Trial {
    EffectTerm hidden;
    Strength got;
};

// One search for the strength that leaves the wanted share: strengths that the axis does not
// survive bound it from above.
class StrengthSearch {
  public:
    StrengthSearch(const Stage& stage, const Hiding& hiding, double wanted)
        : stage_(stage), hiding_(hiding), wanted_(wanted), too_much_(hiding.most),
          s_(std::clamp(hiding.start, hiding.least, hiding.most)) {}

    // The nearest share that was met, not above the wanted one by more than kNear.
    std::optional<Trial> run() {
        for (int step = 0; step < kSteps; ++step) {
            const EffectTerm hidden = hiding_.at(s_);
            const std::optional<Strength> got = stage_.strength(hidden);
            if (got && got->share < kNear * wanted_ && (!best_ || got->share > best_->got.share))
                best_ = Trial{hidden, *got};
            if (best_ && best_->got.share > wanted_ / kNear) break;
            if (!go_on(got)) break;
        }
        return best_;
    }

  private:
    bool go_on(const std::optional<Strength>& got) {
        double next = 0.5 * s_;
        if (got)
            next = s_ * std::clamp(wanted_ / std::max(1e-9, got->share), 0.1, 8.0);
        else
            too_much_ = std::min(too_much_, s_);
        if (next >= too_much_) next = (s_ + too_much_) / 2;
        next = std::clamp(next, hiding_.least, hiding_.most);
        return std::exchange(s_, next) != next;
    }

    const Stage& stage_;
    const Hiding& hiding_;
    double wanted_, too_much_, s_;
    std::optional<Trial> best_;
};

// The effect at a strength that this experiment shows; nothing where there is none.
std::optional<Trial> tuned(const Stage& stage, const Hiding& hiding, double wanted) {
    if (!hiding.at || !(hiding.most > hiding.least)) return {};
    const std::optional<Trial> best = StrengthSearch(stage, hiding, wanted).run();
    if (!best || best->got.share < kLeastAim || !is_shown(best->got)) return {};
    return stage.cannot_show(best->hidden).empty() ? best : std::nullopt;
}

} // namespace

Model with_hidden(Model model, const EffectTerm& hidden) {
    const std::vector<std::string>& replaced = find_effect(hidden.name)->info().replaces;
    std::erase_if(model.effects, [&](const EffectTerm& term) {
        return std::count(replaced.begin(), replaced.end(), term.name) > 0;
    });
    model.effects.push_back(hidden);
    return model;
}

Mystery make_mystery(const Model& model, const Experiment& experiment, std::uint64_t seed,
                     unsigned long noise_seed) {
    const Stage stage(model, experiment, kTuningNoise);
    std::vector<const Effect*> effects = candidates(model);
    Draw order(stage.scenery(), seed, 0);
    shuffle(effects, order);
    std::uint64_t attempt = 0;
    for (const Effect* effect : effects)
        for (int i = 0; i < kDraws; ++i) {
            Draw draw(stage.scenery(), seed, ++attempt);
            const double wanted = draw.log_uniform(kLeastAim, kMostAim);
            const std::optional<Trial> found = tuned(stage, effect->hide(draw), wanted);
            if (!found) continue;
            const Strength shown =
                Stage(model, experiment, noise_seed).strength(found->hidden).value_or(found->got);
            return {seed, found->hidden, model.motion, shown.share, shown.band_Hz};
        }
    throw Refusal("this experiment shows none of the effects that the model lacks",
                  "a move in both directions, with several speeds and a longer travel");
}

} // namespace servoid
