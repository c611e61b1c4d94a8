#include "diagnose/add_effect.hpp"

#include "common/error.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Vector = Eigen::VectorXd;

constexpr size_t kDescents = 2; // starting points that are followed down

Model without_replaced(Model model, const EffectInfo& info) {
    std::erase_if(model.effects, [&](const EffectTerm& term) {
        return std::find(info.replaces.begin(), info.replaces.end(), term.name) !=
               info.replaces.end();
    });
    return model;
}

Model with_term(Model model, const EffectTerm& term) {
    model.effects.push_back(term);
    return model;
}

// The capture with the largest residual, as a search sees it: its used points only.
struct SearchData {
    Vector time_s, position, velocity, acceleration, torque, residual;
    size_t capture = 0;
};

Vector used_of(const Vector& values, const PreparedMotion& m) {
    if (values.size() == 0) return {};
    Vector out(m.used_count());
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < values.size(); ++k)
        if (m.used[size_t(k)]) out[row++] = values[k];
    return out;
}

SearchData search_data(const FitResult& fitted, const std::vector<PreparedMotion>& motions) {
    SearchData out;
    Eigen::Index row = 0, best_row = 0;
    double best = -1;
    for (size_t i = 0; i < motions.size(); ++i) {
        const Eigen::Index n = motions[i].used_count();
        const double power = fitted.residual.segment(row, n).squaredNorm();
        if (power > best) best = power, out.capture = i, best_row = row;
        row += n;
    }
    const PreparedMotion& m = motions[out.capture];
    out.time_s =
        used_of(Vector::LinSpaced(m.grid.count, m.grid.at(0), m.grid.at(m.grid.count - 1)), m);
    out.position = used_of(m.position, m), out.velocity = used_of(m.velocity, m);
    out.acceleration = used_of(m.acceleration, m), out.torque = used_of(m.torque, m);
    out.residual = fitted.residual.segment(best_row, m.used_count());
    return out;
}

} // namespace

FitResult fit_with(const FitResult& fitted, const Effect& effect, Assembler& assembler) {
    const SearchData data = search_data(fitted, assembler.motions());
    assembler.set_artifact(fitted.artifact);
    assembler.set_context(fitted.model);
    const MotionView& motion = assembler.views()[data.capture];
    std::string why; // none of the captures shows it
    for (const MotionView& view : assembler.views())
        if (why = effect.cannot_show(view); why.empty()) break;
    if (!why.empty())
        throw Refusal(effect.info().name + " cannot be seen: " + why, "a move that shows it");
    const Search search{motion,      data.time_s,  data.position, data.velocity, data.acceleration,
                        data.torque, data.residual};
    const Model base = without_replaced(fitted.model, effect.info());
    std::vector<std::pair<double, EffectTerm>> starts;
    for (const EffectTerm& term : effect.starts(search))
        starts.push_back({linear_error(with_term(base, term), assembler), term});
    std::stable_sort(starts.begin(), starts.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::erase_if(starts, [](const auto& s) { return !std::isfinite(s.first); });
    if (starts.empty())
        throw Refusal(effect.info().name + " cannot be told from what the model has",
                      "a move in both directions, several speeds, a longer travel");
    if (starts.size() > kDescents) starts.resize(kDescents);
    const FitOptions quick{.most_iterations = 8,
                           .uncertainty = false,
                           .frozen_terms = base.effects.size(),
                           .believed_terms = base.effects.size(),
                           .start_values = false};
    FitResult best;
    best.torque_error = INFINITY;
    for (const auto& [error, term] : starts) {
        FitResult tried = fit(with_term(base, term), assembler, quick);
        if (tried.torque_error < best.torque_error) best = std::move(tried);
    }
    // The shapes that the model already had are moved too, where the effect is of any use.
    const bool useful = best.torque_error < 0.98 * fitted.torque_error;
    FitOptions last;
    last.believed_terms = base.effects.size();
    last.start_values = false;
    if (!useful) last.frozen_terms = base.effects.size();
    return fit(best.model, assembler, last);
}

Addition add_term(const Model& model, const EffectTerm& term,
                  const std::vector<PreparedMotion>& motions) {
    Assembler assembler(motions);
    Addition out;
    // A model that lacks much may not have a fit: its inertia would come out negative.
    try {
        out.before = fit(model, assembler);
    } catch (const Refusal&) {
        out.before.model = model;
        out.before.torque_error = NAN;
    }
    out.after = fit(with_term(out.before.model, term), assembler);
    return out;
}

Addition add_effect(const Model& model, const std::string& name,
                    const std::vector<PreparedMotion>& motions) {
    const Effect* effect = find_effect(name);
    if (!effect) throw UsageError("no effect is called " + name + "; see: servoid effects");
    if (const std::string why = cannot_add(*effect, model); !why.empty())
        throw UsageError(name + " cannot be added: " + why);
    Assembler assembler(motions);
    Addition out;
    out.before = fit(model, assembler);
    out.after = fit_with(out.before, *effect, assembler);
    return out;
}

} // namespace servoid
