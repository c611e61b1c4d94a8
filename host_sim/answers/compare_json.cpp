#include "answers/compare_json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace servoid {

namespace {

const char* name_of(BandLimit limit) {
    switch (limit) {
    case BandLimit::asked:
        return "asked";
    case BandLimit::torque:
        return "torque";
    case BandLimit::excitation:
        return "excitation";
    case BandLimit::repetition:
        return "repetition";
    case BandLimit::noise:
        return "noise";
    case BandLimit::record:
        return "record";
    case BandLimit::sample_rate:
        return "sample_rate";
    }
    return "";
}

Json where_json(const std::vector<Regime>& where) {
    Json out = Json::array();
    for (const Regime& r : where) {
        out.push_back({{"regime", r.regime},
                       {"group", r.group},
                       {"residual_share", number(r.residual_share)},
                       {"sample_share", number(r.sample_share)}});
        if (std::isfinite(r.mean_residual))
            out.back().update({{"from", r.from}, {"to", r.to}, {"mean_residual", r.mean_residual}});
    }
    return out;
}

Json kinds_json(const LineKinds& kinds) {
    return {{"excited", number(kinds.excited)},
            {"odd", number(kinds.odd)},
            {"even", number(kinds.even)}};
}

Json lines_json(const Lines& lines) {
    Json out = {{"base_Hz", number(lines.base_Hz)}};
    out.update(kinds_json(lines.residual));
    out["between"] = number(lines.between);
    out["mean"] = number(lines.mean);
    out["torque"] = kinds_json(lines.torque);
    out["noise"] = kinds_json(lines.noise);
    out["count"] = {
        {"excited", lines.counts.excited}, {"odd", lines.counts.odd}, {"even", lines.counts.even}};
    return out;
}

} // namespace

Json compare_json(const Comparison& c, const std::vector<std::string>& warnings) {
    Json out = {{"schema", "servoid.compare/1"},
                {"torque_error", number(c.torque_error)},
                {"noise_floor", number(c.floor.ratio)},
                {"noise_floor_from", c.floor.from_repetition ? "repetition" : "quantisation"},
                {"repeatable_share", number(c.floor.repeatable_share)},
                {"loop", nullptr}};
    if (c.loop)
        out["loop"] = {{"torque_error", number(c.loop->torque_error)},
                       {"position_error", number(c.loop->position_error)}};
    out["where"] = where_json(c.where);
    out["lines"] = c.lines ? lines_json(*c.lines) : Json(nullptr);
    out["lag_s"] = c.lag_s ? parameter(c.lag_s->value, c.lag_s->std, "s") : Json(nullptr);
    out["band_Hz"] = c.band_Hz;
    out["band_from"] = name_of(c.band_limited_by);
    out["torque"] = c.torque_name;
    out["samples"] = c.samples;
    out["samples_used_share"] = c.samples_used_share;
    out["duration_s"] = c.duration_s;
    out["warnings"] = warnings;
    return out;
}

} // namespace servoid
