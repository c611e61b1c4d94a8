#include "story/story.hpp"

#include "answers/compare_json.hpp"
#include "answers/diagnose_json.hpp"
#include "compare/loop_twin.hpp"
#include "model/model.hpp"
#include "story/candidate_views.hpp"
#include "story/parameter_table.hpp"
#include "story/sentence.hpp"
#include "story/series.hpp"
#include "story/views.hpp"
#include "story/worst.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace servoid {

namespace {

constexpr size_t kValues = 80000; // of one series, shared by the captures: 0.2 MB of text each

bool ampere(const StoryInput& in) { return in.motions.front().capture->torque_in_ampere; }

Json columns_of(const Capture& c) {
    Json out = Json::array();
    const auto add = [&](const char* name, const std::vector<double>& column) {
        if (!column.empty()) out.push_back(name);
    };
    add("time", c.time_s), add("torque_ref", c.torque_ref), add("torque", c.torque);
    add("position", c.position), add("velocity", c.velocity), add("position_ref", c.position_ref);
    add("velocity_ref", c.velocity_ref), add("load_position", c.load_position);
    return out;
}

struct Shown {
    const StoryInput& in;
    const Scene& scene;
    std::optional<Scene> refined;
    size_t most() const { return std::max<size_t>(4000, kValues / scene.captures.size()); }
};

// As recorded, at the sample rate; times that are not even cannot be drawn so.
void add_recorded(Json& out, const Capture& c, size_t most) {
    const SeriesAxis axis{0, c.uniform ? c.sample_time_s : 0};
    const auto series = [&](const std::vector<double>& column) {
        return c.uniform ? series_json(column, axis, most) : Json(nullptr);
    };
    out["recorded_torque"] = series(c.torque_ref.empty() ? c.torque : c.torque_ref);
}

void add_loop(Json& out, const SceneCapture& c, size_t most) {
    const std::optional<Capture> twin = loop_twin(c.model, *c.motion.capture);
    out["loop_position"] =
        twin ? series_json(twin->position, {0, twin->sample_time_s}, most) : Json(nullptr);
}

Json series_of(const Shown& shown, size_t i) {
    const SceneCapture& c = shown.scene.captures[i];
    const SeriesAxis axis{c.motion.grid.start_s, c.motion.grid.step_s};
    const auto series = [&](const Eigen::VectorXd& values) {
        return series_json({values.data(), size_t(values.size())}, axis, shown.most());
    };
    Json out = Json::object();
    add_recorded(out, *c.motion.capture, shown.most());
    out["torque"] = series(c.delivered);
    out["model_torque"] = series(c.model_torque);
    out["residual"] = series(c.residual());
    out["refined_torque"] =
        shown.refined ? series(shown.refined->captures[i].model_torque) : Json(nullptr);
    out["refined_residual"] =
        shown.refined ? series(shown.refined->captures[i].residual()) : Json(nullptr);
    out["position"] = series(c.motion.position);
    add_loop(out, c, shown.most());
    return out;
}

std::string hash_of(const StoryInput& in, const std::string& path) {
    for (const SourceFile& f : in.provenance.files)
        if (f.file == path) return f.sha256;
    return "";
}

Json captures_of(const Shown& shown) {
    Json out = Json::array();
    for (size_t i = 0; i < shown.scene.captures.size(); ++i) {
        const SceneCapture& c = shown.scene.captures[i];
        const Capture& capture = *c.motion.capture;
        out.push_back({{"file", capture.path},
                       {"sha256", hash_of(shown.in, capture.path)},
                       {"rows", capture.rows()},
                       {"duration_s", capture.time_s.back() - capture.time_s.front()},
                       {"sample_time_s", capture.sample_time_s},
                       {"columns", columns_of(capture)},
                       {"band_Hz", c.motion.band_Hz},
                       {"series", series_of(shown, i)},
                       {"worst", worst_json(c)}});
    }
    return out;
}

// What refining found, where it is not what is shown anyway.
const FitResult* beyond(const StoryInput& in) {
    if (!in.refinement) return nullptr;
    const FitResult& found = in.refinement->result;
    return format_model(found.model) == format_model(in.shown) ? nullptr : &found;
}

Json parameters_of(const StoryInput& in) {
    Json out = {{"before", nullptr}, {"after", nullptr}};
    if (in.fit) out["before"] = parameter_table(*in.fit, in.given, ampere(in));
    if (const FitResult* found = beyond(in))
        out["after"] = parameter_table(*found, in.given, ampere(in));
    return out;
}

void add_answers(Json& out, const StoryInput& in, const Comparison& comparison) {
    std::vector<Capture> captures;
    for (const PreparedMotion& m : in.motions) {
        captures.emplace_back(); // only their names are asked for
        captures.back().path = m.capture->path, captures.back().linear = m.capture->linear;
    }
    out["compare"] = compare_json(comparison, in.warnings);
    out["diagnose"] = in.diagnosis
                          ? diagnosis_json(*in.diagnosis, in.warnings,
                                           zeros_of(homing_of(*in.diagnosis), captures), ampere(in))
                          : Json(nullptr);
    out["refine"] =
        in.refinement
            ? refinement_json(*in.refinement, in.warnings,
                              zeros_of(in.refinement->result.homing, captures), ampere(in))
            : Json(nullptr);
}

} // namespace

Json make_story(const StoryInput& in) {
    const Comparison comparison = compare(in.shown, in.motions);
    const Scene scene = scene_of(in.shown, in.motions, comparison.homing);
    Shown shown{in, scene, std::nullopt};
    const FitResult* refined = beyond(in);
    if (refined) shown.refined.emplace(scene_of(refined->model, in.motions, refined->homing));
    Json out = {
        {"schema", "servoid.story/1"},
        {"title", in.given.name},
        {"unit",
         {{"torque", scene.unit(Quantity::torque)},
          {"position", scene.unit(Quantity::position)},
          {"velocity", scene.unit(Quantity::velocity)},
          {"acceleration", scene.unit(Quantity::acceleration)}}},
        {"verdict", in.diagnosis ? Json(verdict_name(in.diagnosis->verdict)) : Json(nullptr)},
        {"sentence", sentence(comparison, in.diagnosis, in.refinement)},
        {"advice", in.diagnosis ? in.diagnosis->advice : ""},
        {"basis", in.fit ? "fitted" : "as given"},
        {"given_error", number(torque_error_of(in.given, in.motions))}};
    add_answers(out, in, comparison);
    out["model_toml"] = format_model(in.given);
    out["refined_toml"] = refined ? Json(format_model(refined->model)) : Json(nullptr);
    out["captures"] = captures_of(shown);
    out["against"] = against_json(scene);
    out["spectrum"] = spectrum_json(scene, comparison.floor.ratio);
    out["orders"] = orders_json(scene);
    out["response"] = response_json(scene);
    out["candidates"] =
        in.diagnosis ? candidate_views(*in.diagnosis, scene, in.motions) : Json::array();
    out["parameters"] = parameters_of(in);
    out["provenance"] = provenance_json(in.provenance);
    return out;
}

} // namespace servoid
