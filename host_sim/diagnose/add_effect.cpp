#include "diagnose/add_effect.hpp"

#include "common/error.hpp"
#include "compare/homing_search.hpp"
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

// One capture as a search sees it: its used points only.
struct SearchData {
    const MotionView& motion;
    Vector time_s, position, velocity, acceleration, torque, residual;
    Search search() const {
        return {motion, time_s, position, velocity, acceleration, torque, residual};
    }
};

SearchData search_data(const FitResult& fitted, const Assembler& assembler, size_t capture) {
    const PreparedMotion& m = assembler.motions()[capture];
    const Rows rows = assembler.rows_of(capture);
    const Vector time = Vector::LinSpaced(m.grid.count, m.grid.at(0), m.grid.at(m.grid.count - 1));
    return {assembler.views()[capture],
            m.used_rows(time),
            m.position.size() ? Vector(m.used_rows(m.position)) : Vector(),
            m.used_rows(m.velocity),
            m.used_rows(m.acceleration),
            m.used_rows(m.torque),
            fitted.residual.segment(rows.first, rows.count)};
}

// Where a search looks: at the capture with the largest residual, then at the one with the longest
// way, which knows an order best.
std::vector<size_t> searched_captures(const FitResult& fitted, const Assembler& assembler) {
    size_t loudest = 0, longest = 0;
    double most = -1;
    for (size_t i = 0; i < assembler.views().size(); ++i) {
        const Rows rows = assembler.rows_of(i);
        const double power = fitted.residual.segment(rows.first, rows.count).squaredNorm();
        if (power > most) most = power, loudest = i;
        if (assembler.views()[i].travel() > assembler.views()[longest].travel()) longest = i;
    }
    return longest == loudest ? std::vector{loudest} : std::vector{loudest, longest};
}

// A model with one place of the search, where it moves the captures' zeros to, and what it leaves.
struct Start {
    Model model;
    Homing homing;
    double error = 0;
};

Start start_at(Model model, const Homing& homing, Assembler& assembler) {
    assembler.set_homing(homing);
    Start out{std::move(model), {}, 0};
    out.homing = find_homing(out.model, assembler);
    assembler.set_homing(out.homing);
    out.error = linear_error(out.model, assembler);
    return out;
}

std::vector<Start> starts_of(const FitResult& fitted, const Effect& effect, const Model& base,
                             Assembler& assembler) {
    std::vector<Start> out;
    const std::vector<size_t> captures = searched_captures(fitted, assembler);
    for (size_t capture : captures) {
        const SearchData data = search_data(fitted, assembler, capture);
        for (const EffectTerm& term : effect.starts(data.search())) {
            const bool order = effect.phase_per_position(term, base.motion) > 0;
            if (capture != captures.front() && !order) continue;
            out.push_back(start_at(with_term(base, term), fitted.homing, assembler));
        }
    }
    return out;
}

} // namespace

FitResult fit_with(const FitResult& fitted, const Effect& effect, Assembler& assembler) {
    assembler.set_artifact(fitted.artifact);
    assembler.set_homing(fitted.homing);
    assembler.set_context(fitted.model);
    std::string why; // none of the captures shows it
    for (const MotionView& view : assembler.views())
        if (why = effect.cannot_show(view); why.empty()) break;
    if (!why.empty())
        throw Refusal(effect.info().name + " cannot be seen: " + why, "a move that shows it");
    const Model base = without_replaced(fitted.model, effect.info());
    std::vector<Start> starts = starts_of(fitted, effect, base, assembler);
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Start& a, const Start& b) { return a.error < b.error; });
    std::erase_if(starts, [](const Start& s) { return !std::isfinite(s.error); });
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
    for (const Start& start : starts) {
        assembler.set_homing(start.homing);
        FitResult tried = fit(start.model, assembler, quick);
        if (tried.score() < best.score()) best = std::move(tried);
    }
    // The shapes that the model already had are moved too, where the effect is of any use.
    const bool useful = best.torque_error < 0.98 * fitted.torque_error;
    FitOptions last;
    last.believed_terms = base.effects.size();
    last.start_values = false;
    if (!useful) last.frozen_terms = base.effects.size();
    assembler.set_homing(best.homing);
    return home_again(fit(best.model, assembler, last), assembler, last);
}

Addition add_term(const Model& model, const EffectTerm& term,
                  const std::vector<PreparedMotion>& motions) {
    Assembler assembler(motions);
    Addition out;
    // A model that lacks much may not have a fit: its inertia would come out negative.
    try {
        out.before = fit_homed(model, assembler);
    } catch (const Refusal&) {
        out.before.model = model;
        out.before.torque_error = NAN;
    }
    out.after = fit_homed(with_term(out.before.model, term), assembler);
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
    out.before = fit_homed(model, assembler);
    out.after = fit_with(out.before, *effect, assembler);
    if (const std::string why = out_of_bounds(out.after.model); !why.empty())
        throw Refusal(why + ": something else explains this capture",
                      "several turns in both directions, several speeds");
    return out;
}

} // namespace servoid
