#include "answers/diagnose_json.hpp"

#include "answers/model_json.hpp"

#include <nlohmann/json.hpp>

namespace servoid {

namespace {

Json parameters_of(const Candidate& c, const Diagnosis& d, bool ampere) {
    Json out = Json::object();
    for (const FittedParameter& p : c.parameters)
        out[p.name] = parameter(p.estimate.value, p.estimate.std,
                                unit_of(p.quantity, d.before.model.motion, ampere));
    return out;
}

Json candidate_json(const Candidate& c, const Diagnosis& d, bool ampere) {
    Json out = {{"effect", c.effect},
                {"probability", number(c.probability)},
                {"error_after", number(c.error_after)},
                {"validation_error_after", number(c.validation_error_after)},
                {"parameters", parameters_of(c, d, ampere)},
                {"signature", c.signature}};
    if (!c.note.empty()) out["note"] = c.note;
    return out;
}

Json outside_json(const Diagnosis& d) {
    return d.outside.empty() ? Json(nullptr) : Json(d.outside);
}

Json next_json(const std::optional<NextExperiment>& next) {
    if (!next) return nullptr;
    return {{"experiment", next->experiment},
            {"separation", number(next->separation)},
            {"reason", next->reason}};
}

Json cannot_show_json(const std::vector<Unseen>& unseen) {
    Json out = Json::array();
    for (const Unseen& u : unseen)
        out.push_back({{"effect", u.effect}, {"why", u.why}, {"record", u.record}});
    return out;
}

} // namespace

const Homing& homing_of(const Diagnosis& d) {
    const bool found = d.verdict == Verdict::missing || d.verdict == Verdict::ambiguous;
    return found ? d.candidates.front().fit.homing : d.before.homing;
}

Json diagnosis_json(const Diagnosis& d, const Warnings& warnings, const Zeros& zeros, bool ampere) {
    Json out = {{"schema", "servoid.diagnose/1"},
                {"verdict", verdict_name(d.verdict)},
                {"error_before", number(d.error_before)},
                {"validation_error_before", number(d.validation_error_before)},
                {"noise_floor", number(d.noise_floor)},
                {"noise_floor_from", d.floor_from_repetition ? "repetition" : "quantisation"},
                {"band_Hz", d.band_Hz},
                {"candidates", Json::array()}};
    for (const Candidate& c : d.candidates)
        out["candidates"].push_back(candidate_json(c, d, ampere));
    out["probes"] = Json::array();
    for (const Probe& p : d.probes)
        out["probes"].push_back({{"variable", p.name}, {"explained", number(p.explained)}});
    out["model_parameters"] = fitted_parameters(d.before, ampere);
    add_homing(out, zeros);
    out["next_experiment"] = next_json(d.next);
    out["outside"] = outside_json(d);
    out["cannot_show"] = cannot_show_json(d.cannot_show);
    out["warnings"] = warnings;
    if (d.shortage) out["reason"] = d.shortage->why;
    out["advice"] = d.advice;
    return out;
}

Json no_diagnosis() {
    return {{"schema", "servoid.diagnose/1"}, {"verdict", nullptr},
            {"error_before", nullptr},        {"validation_error_before", nullptr},
            {"noise_floor", nullptr},         {"band_Hz", nullptr},
            {"candidates", Json::array()},    {"model_parameters", nullptr},
            {"next_experiment", nullptr},     {"outside", nullptr},
            {"cannot_show", Json::array()},   {"warnings", Json::array()}};
}

Json refinement_json(const Refinement& r, const Warnings& warnings, const Zeros& zeros,
                     bool ampere) {
    Json out = {{"schema", "servoid.refine/1"},
                {"verdict", verdict_name(r.verdict)},
                {"ladder", Json::array()}};
    for (const Rung& rung : r.ladder)
        out["ladder"].push_back({{"added", rung.added.empty() ? Json(nullptr) : Json(rung.added)},
                                 {"torque_error", number(rung.torque_error)},
                                 {"validation_error", number(rung.validation_error)}});
    out["removed"] = r.removed;
    out["model"] = model_json(r.result.model);
    out["model_parameters"] = fitted_parameters(r.result, ampere);
    add_homing(out, zeros);
    out["noise_floor"] = number(r.noise_floor);
    out["band_Hz"] = r.last.band_Hz;
    out["next_experiment"] = next_json(r.last.next);
    out["outside"] = outside_json(r.last);
    out["cannot_show"] = cannot_show_json(r.last.cannot_show);
    out["warnings"] = warnings;
    if (r.last.shortage) out["reason"] = r.last.shortage->why;
    out["advice"] = r.last.advice;
    return out;
}

Json no_refinement() {
    return {{"schema", "servoid.refine/1"},
            {"verdict", nullptr},
            {"ladder", Json::array()},
            {"removed", Json::array()},
            {"model", nullptr},
            {"model_parameters", nullptr},
            {"noise_floor", nullptr},
            {"band_Hz", nullptr},
            {"next_experiment", nullptr},
            {"outside", nullptr},
            {"cannot_show", Json::array()},
            {"warnings", Json::array()}};
}

} // namespace servoid
