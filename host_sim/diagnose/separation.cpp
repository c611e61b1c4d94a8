#include "diagnose/separation.hpp"

#include "compare/compare.hpp"
#include "diagnose/add_effect.hpp"
#include "diagnose/diagnose.hpp"
#include "effects/catalogue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr double kMovesShare = 0.5; // of the record: an axis that mostly sticks shows nothing
constexpr int kFewIterations = 6;

// The record of one rival, and what this rival itself leaves of it.
struct Truth {
    explicit Truth(Capture record)
        : capture(std::move(record)), motions(prepare_all({&capture, 1}, {})), assembler(motions) {}
    Truth(const Truth&) = delete;
    Truth& operator=(const Truth&) = delete;

    Capture capture;
    std::vector<PreparedMotion> motions;
    Assembler assembler;
    FitResult own;
};

// Only the last effect, the one in question, may move its shapes freely.
FitOptions near(const Model& model) {
    FitOptions options;
    options.most_iterations = kFewIterations;
    options.uncertainty = false;
    if (!model.effects.empty()) options.believed_terms = model.effects.size() - 1;
    return options;
}

std::unique_ptr<Truth> truth_of(const Model& model, const Rivalry& r, Capture record) {
    auto out = std::make_unique<Truth>(std::move(record));
    const PreparedMotion& m = out->motions.front();
    if (double(m.used_count()) < kMovesShare * double(m.grid.count))
        throw Refusal(out->capture.path + ": the axis mostly stands still", "a faster move");
    fit(r.base, out->assembler, near(r.base)); // refuses where no diagnosis could begin
    out->own = fit(model, out->assembler, near(model));
    return out;
}

// With its last effect taken off and searched for anew, as a diagnosis does.
std::optional<FitResult> searched(const Model& model, Assembler& assembler) {
    if (model.effects.empty()) return std::nullopt;
    Model base = model;
    const Effect* effect = find_effect(base.effects.back().name);
    base.effects.pop_back();
    if (effect->shape_keys(model.effects.back()).empty())
        return std::nullopt; // nothing to search for
    try {
        return fit_with(fit(base, assembler), *effect, assembler);
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

struct Left {
    double value = 0, noise = 0; // in units of the noise; the noise, N·m or N
    Vector residual;
};

Left left_by(const Model& model, Truth& truth, const Rivalry& rivalry, bool search) {
    FitResult fitted = fit(model, truth.assembler, near(model));
    if (search)
        if (const auto other = searched(model, truth.assembler))
            if (other->torque_error < fitted.torque_error) fitted = *other;
    const double n = double(fitted.residual.size());
    const double own = truth.own.residual.squaredNorm() / n;
    // Noise of a wider band is more, and what the true rival leaves cannot be told from noise.
    const double wider = std::max(1.0, truth.motions.front().band_Hz / rivalry.band_Hz);
    const double noise = std::sqrt(rivalry.noise * rivalry.noise * wider + own);
    const double beyond = std::max(0.0, fitted.residual.squaredNorm() / n - own);
    return {std::sqrt(beyond) / std::max(noise, 1e-300), noise, fitted.residual};
}

std::string where(const PreparedMotion& m, const Vector& residual) {
    Vector all = Vector::Zero(m.grid.count);
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < all.size(); ++k)
        if (m.used[size_t(k)]) all[k] = residual[row++];
    const Regime* most = nullptr;
    const std::vector<Regime> regimes = where_it_fails(m, all);
    for (const Regime& r : regimes)
        if (r.group == "regime" && (!most || r.residual_share > most->residual_share)) most = &r;
    return most ? most->regime : "";
}

std::vector<std::string> names_of(const Model& model) {
    std::vector<std::string> out;
    for (const EffectTerm& term : model.effects)
        out.push_back(term.name);
    return out;
}

// Whether a model has every effect of another, or a richer form of it.
bool extends(const Model& rich, const Model& simple) {
    std::vector<std::string> more = names_of(rich);
    for (const std::string& name : names_of(simple)) {
        const auto same = std::find_if(more.begin(), more.end(), [&](const std::string& other) {
            return other == name || is_richer_form(other, name);
        });
        if (same == more.end()) return false;
        more.erase(same);
    }
    return true;
}

} // namespace

Rivalry::Rivalry(std::vector<Model> models, const std::vector<PreparedMotion>& motions,
                 double noise_rms, const MoveLimits& within)
    : rivals(std::move(models)), limits(within), noise(noise_rms) {
    for (const PreparedMotion& m : motions) {
        band_Hz = std::max(band_Hz, m.band_Hz);
        ampere = ampere || m.capture->torque_in_ampere;
    }
    for (Model& model : rivals)
        if (ampere) model.controller.reset();
    base = rivals.front();
    for (size_t i = base.effects.size(); i-- > 0;)
        if (has_more(base, base.effects[i].name))
            base.effects.erase(base.effects.begin() + long(i));
}

bool Rivalry::has_more(const Model& model, const std::string& effect) const {
    const auto count_in = [&](const Model& m) {
        const auto is_it = [&](const EffectTerm& term) { return term.name == effect; };
        return std::count_if(m.effects.begin(), m.effects.end(), is_it);
    };
    const long own = count_in(model);
    return std::any_of(rivals.begin(), rivals.end(),
                       [&](const Model& m) { return count_in(m) < own; });
}

bool Rivalry::tells(size_t truth, size_t fitted) const {
    const Model &a = rivals[truth], &b = rivals[fitted];
    return !extends(b, a) || extends(a, b);
}

std::string Rivalry::name_of(size_t rival) const {
    std::vector<std::string> names;
    for (const std::string& name : names_of(rivals[rival]))
        if (has_more(rivals[rival], name) &&
            std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    return names.empty() ? "no further effect" : fmt::format("{}", fmt::join(names, " with "));
}

double screen(const Rivalry& r, const std::string& experiment, Capture first, double least) {
    const std::unique_ptr<Truth> best = truth_of(r.rivals[0], r, std::move(first));
    double out = INFINITY;
    for (size_t j = 1; j < r.rivals.size(); ++j)
        if (r.tells(0, j)) out = std::min(out, left_by(r.rivals[j], *best, r, false).value);
    for (size_t j = 1; j < r.rivals.size(); ++j) {
        // The way back costs another simulation: where it is the only one, or one is all it costs.
        const bool wanted = r.tells(j, 0) && (r.rivals.size() == 2 || !r.tells(0, j));
        if (!wanted || out < least) continue;
        const Model& rival = r.rivals[j];
        const auto truth =
            truth_of(rival, r, record_of(rival, parse_experiment(experiment), r.limits));
        out = std::min(out, left_by(r.rivals[0], *truth, r, false).value);
    }
    return out;
}

Separation separation(const Rivalry& r, const std::string& experiment, double least) {
    Separation out;
    out.value = INFINITY;
    for (size_t i = 0; i < r.rivals.size(); ++i) {
        Capture record = record_of(r.rivals[i], parse_experiment(experiment), r.limits);
        ++out.fits;
        if (use_of(record, r.limits).most() >= 1)
            throw Refusal(experiment + ": a rival leaves the limits", "a gentler move");
        const std::unique_ptr<Truth> truth = truth_of(r.rivals[i], r, std::move(record));
        for (size_t j = 0; j < r.rivals.size() && out.value > least; ++j) {
            if (j == i || !r.tells(i, j)) continue;
            const Left left = left_by(r.rivals[j], *truth, r, i == 0 || j == 0);
            ++out.fits;
            if (left.value >= out.value) continue;
            const PreparedMotion& m = truth->motions.front();
            out = {left.value, i, j, left.noise, m.band_Hz, where(m, left.residual), out.fits};
        }
        if (out.value <= least) break;
    }
    return out;
}

} // namespace servoid
