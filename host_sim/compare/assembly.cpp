#include "compare/assembly.hpp"

#include "common/error.hpp"
#include "effects/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kBlocksPerCapture = 24;
constexpr size_t kMostCached = 400;
constexpr int kMostPasses = 20;   // of a torque that depends on itself: 0.6 of it leaves 4e-5
constexpr double kSettled = 1e-6; // of the torque

const Effect& effect_of(const EffectTerm& term) {
    const Effect* effect = find_effect(term.name);
    if (!effect) throw Error(ExitCode::defect, "no such effect: " + term.name);
    return *effect;
}

std::string key_of(const EffectTerm& term) {
    std::string key = term.name + term.law;
    for (const auto& [name, value] : term.parameters)
        key += fmt::format(",{:a}", value);
    return key;
}

// Blocks of equal length of the record.
int block_at(const PreparedMotion& m, Eigen::Index k) {
    return int(k * kBlocksPerCapture / std::max<Eigen::Index>(1, m.grid.count));
}

} // namespace

bool is_friction(const std::string& effect) {
    return effect.starts_with("viscous") || effect.starts_with("coulomb") || effect == "stribeck" ||
           effect == "presliding";
}

std::vector<Coefficient> coefficients_of(const Model& model) {
    std::vector<Coefficient> out = {{-1, 0, model.inertia_fixed, 0, false}};
    for (size_t i = 0; i < model.effects.size(); ++i) {
        const EffectTerm& term = model.effects[i];
        const Effect& effect = effect_of(term);
        for (int k = 0; k < effect.linear_count(term); ++k)
            out.push_back({int(i), k, effect.linear_fixed(term, k), effect.linear_lower(k),
                           effect.may_vanish(k)});
    }
    return out;
}

Vector coefficient_values(const Model& model) {
    std::vector<double> values = {model.inertia};
    for (const EffectTerm& term : model.effects) {
        const Vector linear = effect_of(term).linear(term);
        values.insert(values.end(), linear.begin(), linear.end());
    }
    return Eigen::Map<Vector>(values.data(), Eigen::Index(values.size()));
}

void set_coefficient_values(Model& model, const Vector& values) {
    model.inertia = values[0];
    Eigen::Index next = 1;
    for (EffectTerm& term : model.effects) {
        const Effect& effect = effect_of(term);
        const int count = effect.linear_count(term);
        effect.set_linear(term, values.segment(next, count));
        next += count;
    }
}

TorqueSignal delivered_by(const Model& model, TorqueSignal asked) {
    for (const EffectTerm& term : model.effects)
        effect_of(term).deliver(term, asked);
    return asked;
}

double noise_passed(const Model& model, const std::vector<PreparedMotion>& motions) {
    double power = 0, all = 0;
    for (const PreparedMotion& m : motions) {
        double share = 1;
        for (const EffectTerm& term : model.effects)
            share *= effect_of(term).noise_passed(term, m.asked, m.motion);
        power += share * share * double(m.used_count()), all += double(m.used_count());
    }
    return std::sqrt(power / all);
}

Assembler::Assembler(const std::vector<PreparedMotion>& motions) : motions_(motions) {
    for (size_t i = 0; i < motions.size(); ++i) {
        views_.push_back(motions[i].motion);
        const int first = int(i) * kBlocksPerCapture;
        rows_.push_back({Eigen::Index(block_.size()), motions[i].used_count()});
        for (Eigen::Index k = 0; k < motions[i].grid.count; ++k)
            if (motions[i].used[size_t(k)]) block_.push_back(first + block_at(motions[i], k));
    }
    double fastest = 0;
    for (const MotionView& view : views_)
        fastest = std::max(fastest, view.top_speed());
    for (MotionView& view : views_)
        view.fastest = fastest;
    artifact_ = Vector::Zero(Eigen::Index(block_.size()));
}

namespace {

// `torque`: what came out; `view`: what it was made from.
void refuse_if_undefined(const Model& model, const MotionView& view, const Vector& torque) {
    if (torque.allFinite()) return;
    for (const EffectTerm& term : model.effects)
        if (const std::string where = effect_of(term).undefined(term, view); !where.empty())
            throw Refusal(where, "a motion on which the law has a value, or change the law");
}

} // namespace

namespace {

void tell_of_load(const Model& model, MotionView& view) {
    const EffectTerm* e = model.find("elastic_load");
    const double ratio = e ? e->at("antiresonance_frequency") / e->at("resonance_frequency") : 1;
    view.load_share = std::max(0.0, 1 - ratio * ratio);
}

} // namespace

MotionView in_context(const Model& model, MotionView view) {
    tell_of_load(model, view);
    view.inertia = model.inertia;
    view.viscous = 0;
    view.has_constant = model.find("constant_torque") != nullptr;
    view.friction = Vector::Zero(view.size());
    Vector inertia = view.acceleration;
    for (const EffectTerm& term : model.effects) {
        const Effect& effect = effect_of(term);
        effect.shape_inertia(term, view, inertia);
        if (term.name == "viscous") view.viscous = term.at("coefficient");
        if (is_friction(term.name))
            view.friction += effect.columns(term, view) * effect.linear(term);
    }
    // First without the effects that depend on the torque, then what they make of that torque.
    view.torque = model.inertia * inertia + view.friction;
    for (const EffectTerm& term : model.effects) {
        const Effect& effect = effect_of(term);
        if (!is_friction(term.name) && !effect.uses_torque(term) && effect.linear_count(term) > 0)
            view.torque += effect.columns(term, view) * effect.linear(term);
    }
    refuse_if_undefined(model, view, view.torque);
    const Vector torque = view.torque;
    // Each pass leaves a share of its change: the friction per torque, or the depth of a ripple.
    for (int pass = 0; pass < kMostPasses; ++pass) {
        Vector more = torque;
        for (const EffectTerm& term : model.effects) {
            const Effect& effect = effect_of(term);
            if (effect.uses_torque(term)) more += effect.columns(term, view) * effect.linear(term);
        }
        const double change = (more - view.torque).norm();
        if (!std::isfinite(change)) refuse_if_undefined(model, view, more);
        view.torque = more;
        if (change <= kSettled * more.norm()) break;
    }
    return view;
}

void Assembler::set_context(const Model& model) {
    for (size_t i = 0; i < views_.size(); ++i)
        views_[i] = in_context(at_zero(model, homing_.of(i)), std::move(views_[i]));
    // Only laws that look at the rest of the model are computed anew.
    context_ = fmt::format("{:a}", model.inertia);
    for (const EffectTerm& term : model.effects)
        context_ += key_of(term);
    for (const Estimate& offset : homing_.offset)
        context_ += fmt::format("@{:a}", offset.value);
}

namespace {

void append_rows(Matrix& all, const Matrix& more) {
    const Eigen::Index before = all.rows();
    all.conservativeResize(before + more.rows(), more.cols());
    all.bottomRows(more.rows()) = more;
}

} // namespace

const Matrix& Assembler::columns_of(const EffectTerm& term) {
    const Effect& effect = effect_of(term);
    std::string key = key_of(term);
    if (effect.depends_on_model(term)) key += "|" + context_;
    auto found = cache_.find(key);
    if (found != cache_.end()) return found->second;
    Matrix all(0, effect.linear_count(term));
    for (size_t i = 0; i < motions_.size(); ++i)
        append_rows(all,
                    motions_[i].used_rows(motions_[i].band_limit(effect.columns(term, views_[i]))));
    return cache_.emplace(key, std::move(all)).first->second;
}

const Matrix& Assembler::inertia_of(const Model& model) {
    std::string key = "inertia";
    for (const EffectTerm& term : model.effects) {
        const Effect& effect = effect_of(term);
        if (effect.shapes_inertia()) key += key_of(term);
    }
    auto found = cache_.find(key);
    if (found != cache_.end()) return found->second;
    Matrix all(0, 1);
    for (size_t i = 0; i < motions_.size(); ++i) {
        tell_of_load(model, views_[i]); // shapes move between two contexts
        Vector inertia = views_[i].acceleration;
        for (const EffectTerm& term : model.effects)
            effect_of(term).shape_inertia(term, views_[i], inertia);
        append_rows(all, motions_[i].used_rows(motions_[i].band_limit(Matrix(inertia))));
    }
    return cache_.emplace(key, std::move(all)).first->second;
}

const Matrix& Assembler::torque_of(const Model& model) {
    std::string key = "torque";
    for (const EffectTerm& term : model.effects)
        if (effect_of(term).delivers()) key += key_of(term);
    auto found = cache_.find(key);
    if (found != cache_.end()) return found->second;
    Matrix all(0, 1);
    for (const PreparedMotion& m : motions_)
        append_rows(all, m.used_rows(m.band_limit(delivered_by(model, m.asked))));
    return cache_.emplace(key, std::move(all)).first->second;
}

Assembly Assembler::assemble(const Model& model) {
    if (cache_.size() > kMostCached) cache_.clear();
    Assembly out;
    out.coefficients = coefficients_of(model);
    out.block = block_;
    out.torque = torque_of(model).col(0) - artifact_;
    out.columns.resize(Eigen::Index(block_.size()), Eigen::Index(out.coefficients.size()));
    out.columns.col(0) = inertia_of(model);
    Eigen::Index next = 1;
    for (const EffectTerm& term : model.effects) {
        const int count = effect_of(term).linear_count(term);
        if (count == 0) continue;
        out.columns.middleCols(next, count) = columns_of(term);
        next += count;
    }
    const std::vector<PositionWave> waves = waves_of(model);
    for (size_t i = 0; i < rows_.size(); ++i)
        if (homing_.moved(i))
            turn(out.columns.middleRows(rows_[i].first, rows_[i].count), waves, homing_.of(i));
    return out;
}

} // namespace servoid
