#include "compare/homing_search.hpp"

#include "common/error.hpp"
#include "compare/homing_scan.hpp"
#include "compare/uncertainty.hpp"
#include "effects/catalogue.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double kSame = 0.1; // rad of the fastest wave
constexpr int kHeldPasses = 2;
constexpr double kBeyondDoubt = 10; // standard deviations

Homing homing_of(const Offsets& offsets) {
    Homing out;
    for (double offset : offsets)
        out.offset.push_back({offset, 0});
    return out.all_moved().empty() ? Homing{} : out;
}

// The captures that may have an offset: all with a position after the first of those.
std::vector<size_t> later_captures(const std::vector<PreparedMotion>& motions) {
    std::vector<size_t> out;
    for (size_t i = 0; i < motions.size(); ++i)
        if (motions[i].motion.position.size() > 0) out.push_back(i);
    if (!out.empty()) out.erase(out.begin());
    return out;
}

bool may_move(const Model& model, const Assembler& assembler) {
    return !waves_of(model).empty() && !later_captures(assembler.motions()).empty();
}

// Where one of the captures before `end` lies: at the best place, where it is clearly better than
// the one that is held, which must be clearly better than none.
double justified_place(const HomingScan& scan, Offsets at, size_t capture, size_t end,
                       double held) {
    const Matrix others = scan.all_but(capture, at, end);
    const double best = scan.best_place(others, capture);
    at[capture] = best;
    const double count = scan.count(at, end);
    const auto gain = [&](double place, double over) {
        return 0.5 * count *
               std::log(scan.power(others, capture, over) /
                        std::max(1e-300, scan.power(others, capture, place)));
    };
    double place = best;
    if (held != 0) {
        const double here = scan.refined(others, capture, held);
        if (!(gain(best, here) > scan.price())) place = here;
    }
    return gain(place, 0) > scan.price() ? place : 0;
}

bool differs(const Homing& a, const Homing& b, double kappa) {
    for (size_t i = 0; i < std::max(a.offset.size(), b.offset.size()); ++i)
        if (a.moved(i) != b.moved(i) || kappa * std::abs(a.of(i) - b.of(i)) > kSame) return true;
    return false;
}

// The places that the captures demand, at the model's shapes.
Homing demanded(const Model& model, Assembler& assembler) {
    const HomingScan scan(model, assembler, false);
    const std::vector<size_t> which = later_captures(assembler.motions());
    const Homing& held = assembler.homing();
    Offsets at(scan.captures(), 0.0);
    for (size_t capture : which) // each against those before it, then against all
        at[capture] = justified_place(scan, at, capture, capture + 1, held.of(capture));
    if (which.size() > 1)
        for (size_t capture : which)
            at[capture] = justified_place(scan, at, capture, at.size(), at[capture]);
    return homing_of(at);
}

// The best ones of those that have none, demanded or not.
Homing best_homing(const Model& model, Assembler& assembler) {
    const HomingScan scan(model, assembler, false);
    Offsets at;
    for (size_t i = 0; i < scan.captures(); ++i)
        at.push_back(assembler.homing().of(i));
    for (size_t capture : later_captures(assembler.motions()))
        if (at[capture] == 0)
            at[capture] = scan.best_place(scan.all_but(capture, at, at.size()), capture);
    return homing_of(at);
}

// The fit with zeros elsewhere; nothing where that leaves laws that cannot be told apart.
std::optional<FitResult> fit_at(Homing homing, const Model& model, Assembler& assembler,
                                const FitOptions& options) {
    assembler.set_homing(std::move(homing));
    try {
        return fit(model, assembler, options);
    } catch (const Refusal&) {
        return std::nullopt;
    }
}

// A fit that found other zeros once its shapes had moved.
FitResult moved_again(FitResult fitted, Assembler& assembler, const FitOptions& options) {
    assembler.set_homing(fitted.homing);
    assembler.set_context(fitted.model);
    const Homing found = demanded(fitted.model, assembler);
    if (!differs(found, fitted.homing, fastest_wave(waves_of(fitted.model)))) return fitted;
    const auto again = fit_at(found, fitted.model, assembler, options);
    return again ? *again : fitted;
}

bool has_free_orders(const Model& model, const FitOptions& options) {
    const std::vector<Shape> shapes = shapes_of(model, options.frozen_terms);
    return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
        const EffectTerm& term = model.effects[shape.term];
        return find_effect(term.name)->phase_per_position(term, model.motion) > 0;
    });
}

// By how much, as a logarithm of the likelihood, one fit explains more than another.
double gain_of(const FitResult& after, const FitResult& before, const Assembler& assembler) {
    double count = 0;
    for (size_t i = 0; i < assembler.motions().size(); ++i) {
        const Rows r = assembler.rows_of(i);
        count += independent_numbers(after.residual.segment(r.first, r.count));
    }
    return count * std::log(before.torque_error / std::max(1e-300, after.torque_error));
}

// An order may have moved until waves of captures with different zeros met: no place is then better
// than 0. With the zeros free it goes back to what each capture says by itself, and they are judged
// there.
FitResult with_orders_free(FitResult fitted, Assembler& assembler, const FitOptions& options) {
    const size_t moved = fitted.homing.all_moved().size();
    const bool all_moved = moved == later_captures(assembler.motions()).size();
    if (all_moved || !has_free_orders(fitted.model, options)) return fitted;
    FitOptions quick = options;
    quick.uncertainty = false;
    assembler.set_homing(fitted.homing);
    const Homing best = best_homing(fitted.model, assembler);
    const auto free = fit_at(best, fitted.model, assembler, quick);
    if (!free) return fitted;
    const Homing found = demanded(free->model, assembler);
    const size_t more = found.all_moved().size();
    if (more <= moved) return fitted;
    const auto out = fit_at(found, free->model, assembler, options);
    const double price = double(more - moved) * price_of_offset(waves_of(fitted.model));
    return out && gain_of(*out, fitted, assembler) > price ? *out : fitted;
}

// A fit may lead round the period, which is where the capture was.
Homing nearest(Homing homing, const Model& model) {
    const std::vector<PositionWave> waves = waves_of(model);
    for (Estimate& offset : homing.offset)
        offset.value = std::remainder(offset.value, period_of(waves));
    return homing;
}

// An order that was fitted beside an offset may need it where another order needs none: one that is
// not many of its standard deviations from 0 is left out, and all of it fitted again.
FitResult without_idle_offsets(FitResult fitted, Assembler& assembler, const FitOptions& options) {
    if (waves_of(fitted.model).size() == 1)
        fitted.homing = nearest(std::move(fitted.homing), fitted.model);
    const double price = price_of_offset(waves_of(fitted.model));
    for (size_t capture : fitted.homing.all_moved()) {
        const Estimate& offset = fitted.homing.offset[capture];
        if (std::abs(offset.value) > kBeyondDoubt * offset.std) continue;
        Homing without = fitted.homing;
        without.offset[capture] = {};
        const auto tried = fit_at(without, fitted.model, assembler, options);
        if (tried && gain_of(fitted, *tried, assembler) <= price) fitted = *tried;
    }
    return fitted;
}

// A wave without a size says nothing, and a fast one would ask for many places.
Model without_flat_waves(Model model) {
    std::erase_if(model.effects, [&](const EffectTerm& term) {
        const Effect& effect = *find_effect(term.name);
        return effect.phase_per_position(term, model.motion) > 0 && effect.linear(term).isZero(0);
    });
    return model;
}

double torque_error(const Model& model, const PreparedMotion& motion) {
    const Vector delivered = delivered_torque(model, motion);
    const double power = motion.used_power(delivered - model_torque(model, motion));
    return std::sqrt(power / std::max(1e-300, motion.used_power(delivered)));
}

} // namespace

Homing find_homing(const Model& model, Assembler& assembler) {
    return may_move(model, assembler) ? demanded(model, assembler) : Homing{};
}

void home(const Model& model, Assembler& assembler) {
    if (!may_move(model, assembler)) return;
    assembler.set_context(model);
    assembler.set_homing(find_homing(model, assembler));
}

FitResult home_again(FitResult fitted, Assembler& assembler, const FitOptions& options) {
    if (!may_move(fitted.model, assembler)) return fitted;
    fitted = moved_again(std::move(fitted), assembler, options);
    fitted = with_orders_free(std::move(fitted), assembler, options);
    fitted = without_idle_offsets(std::move(fitted), assembler, options);
    assembler.set_homing(fitted.homing);
    return fitted;
}

FitResult fit_homed(const Model& model, Assembler& assembler, const FitOptions& options) {
    home(model, assembler);
    return home_again(fit(model, assembler, options), assembler, options);
}

std::optional<ZeroOffset> offset_against(const Model& believed, const PreparedMotion& motion) {
    const Model model = without_flat_waves(believed);
    if (waves_of(model).empty() || motion.motion.position.size() == 0) return std::nullopt;
    const std::vector<PreparedMotion> one = {motion};
    Assembler assembler(one);
    Estimate offset;
    double count = 0, price = 0;
    for (int pass = 0; pass < kHeldPasses; ++pass) { // what depends on the torque moves with it
        assembler.set_homing({{offset}});
        assembler.set_context(model);
        const HomingScan scan(model, assembler, true);
        const double place = scan.best_place(scan.all_but(0, {0}, 1), 0);
        offset = {place, scan.std_of(place)};
        count = scan.count({place}, 1), price = scan.price();
    }
    const ZeroOffset out{offset, torque_error(model, motion),
                         torque_error(at_zero(model, offset.value), motion)};
    if (!(count * std::log(out.error_before / out.error) > price)) return std::nullopt;
    return out;
}

Homing homing_against(const Model& model, const std::vector<PreparedMotion>& motions,
                      size_t first) {
    Homing out{std::vector<Estimate>(motions.size())};
    for (size_t i = first; i < motions.size(); ++i)
        if (const auto found = offset_against(model, motions[i])) out.offset[i] = found->offset;
    return out.all_moved().empty() ? Homing{} : out;
}

} // namespace servoid
