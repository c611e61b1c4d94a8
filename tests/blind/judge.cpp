#include "blind/judge.hpp"

#include "common/error.hpp"
#include "compare/compare.hpp"
#include "diagnose/twin.hpp"
#include "effects/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>
#include <span>

namespace blind {

namespace {

using servoid::Candidate;
using servoid::EffectTerm;

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

double travel_of(const Case& c) {
    const auto& x = c.capture.position;
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    return *high - *low;
}

// Presliding whose bending cannot be told from a jump: shorter than eight counts, or passed within
// half a period of the band's edge at the typical speed.
bool bends_too_fast(const Case& c, const EffectTerm& e, double band_Hz) {
    const double length = e.at("torque") / e.at("stiffness");
    double way = 0;
    const auto& x = c.capture.position;
    for (size_t k = 1; k < x.size(); ++k)
        way += std::abs(x[k] - x[k - 1]);
    const double speed = way / (static_cast<double>(x.size()) * c.capture.sample_time_s);
    return length < 8 * c.world.quantum || length < 0.1 * speed / band_Hz;
}

std::vector<std::string> equals_of(const Case& c, const EffectTerm& e, double band_Hz) {
    std::vector<std::string> out = {e.name};
    if (e.name == "coulomb_asymmetric") {
        if (!c.has_coulomb) out.push_back("coulomb");
        if (!c.has_constant) out.push_back("constant_torque");
    }
    if (e.name == "viscous_asymmetric" && !c.has_viscous) out.push_back("viscous");
    if (e.name == "presliding" && !c.has_coulomb && bends_too_fast(c, e, band_Hz))
        out.push_back("coulomb");
    return out;
}

// The truth in the parameters of the effect that was named.
std::map<std::string, double> truth_as(const Case& c, const std::string& named) {
    for (const EffectTerm& e : c.hidden) {
        if (e.name == named) {
            std::map<std::string, double> out = e.parameters;
            if (named == "backlash" && c.system.modes_known) out.erase("load_share");
            if (named == "spring" && c.has_constant) out.erase("rest_position"); // one and the same
            return out;
        }
        if (e.name == "coulomb_asymmetric") {
            const double f = e.at("torque_forward"), r = e.at("torque_reverse");
            if (named == "coulomb") return {{"torque", (f + r) / 2}};
            if (named == "constant_torque") return {{"torque", (f - r) / 2}};
        }
        if (e.name == "presliding" && named == "coulomb") return {{"torque", e.at("torque")}};
    }
    return {};
}

// Angles count modulo a turn and within 0.05 rad; a rest position within 5 % of the travel.
ParameterCheck check(const Case& c, const std::string& key, double truth,
                     const servoid::Estimate& estimate) {
    ParameterCheck out{key, truth, estimate.value, estimate.std, false};
    double error = std::abs(estimate.value - truth);
    double within = 0.05 * std::abs(truth);
    if (key == "phase") {
        error = std::abs(std::remainder(estimate.value - truth, 2 * std::numbers::pi));
        within = 0.05;
    }
    if (key == "rest_position") within = 0.05 * travel_of(c);
    out.good = error <= within || error <= 3 * estimate.std;
    return out;
}

std::vector<ParameterCheck> check_all(const Case& c, const Candidate& candidate) {
    std::vector<ParameterCheck> out;
    const auto truth = truth_as(c, candidate.effect);
    for (const servoid::FittedParameter& p : candidate.parameters) {
        const auto found = truth.find(last_part(p.name));
        if (found != truth.end()) out.push_back(check(c, found->first, found->second, p.estimate));
    }
    return out;
}

// The noise of the world in a band, as a share of the torque there.
double true_floor(const Case& c, double band_Hz) {
    return band_Hz > 0 ? measure(c.world, c.base, c.known, c.record, band_Hz).floor : 0;
}

// What a complete model leaves: the floor of anyone who knows the effect but not its numbers.
double complete_error(const Case& c, const std::vector<servoid::PreparedMotion>& motions) {
    servoid::Model model = c.known;
    for (const EffectTerm& e : c.hidden) {
        if (!servoid::find_effect(e.name)) return 0;
        std::erase_if(model.effects,
                      [&](const EffectTerm& t) { return e.name == t.name + "_asymmetric"; });
        model.effects.push_back(e);
    }
    servoid::Assembler assembler(motions);
    return servoid::without_artifact(servoid::fit(model, assembler), assembler, 2).torque_error;
}

Verdict start(const Case& c) {
    Verdict v;
    for (const EffectTerm& e : c.hidden)
        v.truth += (v.truth.empty() ? "" : "+") + e.name;
    if (v.truth.empty()) v.truth = "nothing";
    return v;
}

bool is_one_of(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void take(Verdict& v, const Case& c, const servoid::Diagnosis& d) {
    v.verdict = servoid::verdict_name(d.verdict);
    v.error_before = d.error_before;
    v.floor = d.noise_floor;
    v.band_Hz = d.band_Hz;
    v.true_floor = true_floor(c, d.band_Hz);
    v.named = v.verdict;
    if (d.candidates.empty()) return;
    const Candidate& first = d.candidates.front();
    v.first = first.effect;
    v.probability = first.probability;
    v.error_after = first.error_after;
    const bool forward =
        d.verdict == servoid::Verdict::missing || d.verdict == servoid::Verdict::ambiguous;
    if (!forward) return;
    v.named = first.effect;
    for (const EffectTerm& e : c.hidden)
        v.first_right |= is_one_of(equals_of(c, e, d.band_Hz), first.effect);
    if (v.first_right) v.parameters = check_all(c, first);
}

} // namespace

std::vector<std::string> right_names(const Case& c) {
    std::vector<std::string> out;
    for (const EffectTerm& e : c.hidden)
        for (const std::string& name : equals_of(c, e, 0))
            out.push_back(name);
    return out;
}

bool as_it_should(const Case& c, const Verdict& v) {
    if (c.hidden.empty()) return v.verdict == "adequate";
    if (is_one_of(foreign_effects(), c.hidden.front().name))
        return v.verdict == "unknown" || v.verdict == "ambiguous";
    return v.first_right;
}

std::string describe(const Case& c, const Verdict& v, bool verbose) {
    std::string out =
        fmt::format("{} {:<22} #{:<3} {:<9} {:<22} p {:.3f}  before {:.4f} after "
                    "{:.4f} floor {:.4f} (true {:.4f}) "
                    "{:.2f} s\n",
                    as_it_should(c, v) ? "  " : "!!", v.truth, c.seed, v.verdict, v.first,
                    v.probability, v.error_before, v.error_after, v.floor, v.true_floor, v.seconds);
    if (!v.failure.empty()) out += "    thrown: " + v.failure + "\n";
    if (!v.ladder.empty()) out += fmt::format("    ladder: {}\n", fmt::join(v.ladder, " → "));
    if (!verbose) return out;
    out += fmt::format("    {}, {} bit, noise {:.2f} % of rated; {}\n", c.system.name,
                       c.system.bits, 100 * c.torque_noise, c.experiment);
    out +=
        fmt::format("    strength: {:.2f} % of torque, {:.1f} × noise; band {:.3g} Hz; torque rms "
                    "{:.4g}\n    known:",
                    100 * c.strength.share, c.strength.ratio(), v.band_Hz, c.strength.torque_rms);
    for (const EffectTerm& e : c.known.effects)
        out += " " + e.name;
    for (const EffectTerm& e : c.hidden) {
        out += "\n    hidden: " + e.name;
        for (const auto& [key, value] : e.parameters)
            out += fmt::format(" {} {:.5g}", key, value);
    }
    for (size_t i = 0; i < std::min<size_t>(5, v.diagnosis.candidates.size()); ++i) {
        const Candidate& k = v.diagnosis.candidates[i];
        out += fmt::format("\n    {}. {:<22} p {:.3f} after {:.5f} validation {:.5f}", i + 1,
                           k.effect, k.probability, k.error_after, k.validation_error_after);
        for (const servoid::FittedParameter& p : k.parameters)
            out += fmt::format(" {} {:.5g}±{:.2g}", last_part(p.name), p.estimate.value,
                               p.estimate.std);
        if (k.noise_gain > 0) out += fmt::format(" (noise would gain {:.3f})", k.noise_gain);
        if (!k.note.empty()) out += " [" + k.note + "]";
    }
    for (size_t i = 0; i < std::min<size_t>(3, v.diagnosis.probes.size()); ++i) {
        const servoid::Probe& p = v.diagnosis.probes[i];
        out += fmt::format("\n    probe {}: {:.3f}, z {:.1f}", p.name, p.explained, p.z);
    }
    for (const ParameterCheck& p : v.parameters)
        if (!p.good)
            out += fmt::format("\n    wrong: {} is {:.5g}, said {:.5g} ± {:.2g}", p.name, p.truth,
                               p.value, p.std);
    return out + "\n    advice: " + v.diagnosis.advice + "\n";
}

Verdict judge(const Case& c) {
    Verdict v = start(c);
    const auto begin = std::chrono::steady_clock::now();
    try {
        const auto motions = servoid::prepare_all(std::span(&c.capture, 1), {});
        v.diagnosis = servoid::diagnose(c.known, motions);
        take(v, c, v.diagnosis);
        if (!c.hidden.empty()) v.complete_error = complete_error(c, motions);
    } catch (const std::exception& e) {
        v.failure = e.what();
        v.named = v.verdict = "thrown";
    }
    v.seconds = seconds_since(begin);
    return v;
}

Verdict judge_refine(const Case& c) {
    Verdict v = start(c);
    const auto begin = std::chrono::steady_clock::now();
    try {
        const auto motions = servoid::prepare_all(std::span(&c.capture, 1), {});
        const servoid::Refinement r = servoid::refine(c.known, motions, {});
        v.diagnosis = r.last;
        v.verdict = servoid::verdict_name(r.verdict);
        v.floor = r.noise_floor;
        v.true_floor = true_floor(c, r.last.band_Hz);
        for (const servoid::Rung& rung : r.ladder) {
            v.ladder.push_back(rung.added);
            v.error_after = rung.torque_error;
        }
        if (!r.ladder.empty()) v.error_before = r.ladder.front().torque_error;
        const auto in_model = [&](const std::string& name) {
            return r.result.model.find(name) != nullptr;
        };
        v.all_found = true;
        for (const EffectTerm& e : c.hidden) {
            const auto names = equals_of(c, e, r.last.band_Hz);
            v.all_found &= std::any_of(names.begin(), names.end(), in_model);
        }
        v.first_right = v.all_found;
    } catch (const std::exception& e) {
        v.failure = e.what();
        v.verdict = "thrown";
    }
    v.seconds = seconds_since(begin);
    return v;
}

} // namespace blind
