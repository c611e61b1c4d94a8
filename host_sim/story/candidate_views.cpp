#include "story/candidate_views.hpp"

#include "effects/catalogue.hpp"
#include "story/transfer.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace servoid {

namespace {

using Vectors = std::vector<Eigen::VectorXd>;

constexpr size_t kMost = 8;
constexpr size_t kBins = 32;

// What the effect, with everything else fitted again, takes of the residual.
Vectors taken_by(const Candidate& candidate, const Vectors& residual,
                 const std::vector<PreparedMotion>& motions) {
    Vectors out = residuals_of(scene_of(candidate.fit.model, motions, candidate.fit.homing));
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = residual[i] - out[i];
    return out;
}

// The same bins for both, so that the two curves can be laid over each other.
Json over_bins(Against against, const Scene& scene, const Vectors& residual, const Vectors& taken) {
    std::vector<double> x, r, t;
    const auto r_bins = mean_over(points_against(against, scene, residual), kBins);
    const auto t_bins = mean_over(points_against(against, scene, taken), kBins);
    const auto put = [&](double place, double left, double by_effect) {
        x.push_back(place), r.push_back(left), t.push_back(by_effect);
    };
    for (size_t i = 0; i < r_bins.size(); ++i) {
        const bool gap = i > 0 && r_bins[i].from > r_bins[i - 1].to + 1e-9 * r_bins[i].width();
        if (gap) put(r_bins[i].from, NAN, NAN); // nothing was seen there: no line across
        put(r_bins[i].middle(), r_bins[i].mean, t_bins[i].mean);
    }
    return {{"x", numbers(x)}, {"residual", numbers(r)}, {"effect_torque", numbers(t)}};
}

// Line by line, in % of the model's torque: the part in phase with it, or a quarter of a turn off.
Json over_lines(Against against, const Scene& scene, const Vectors& residual,
                const Vectors& taken) {
    const SceneCapture& c = scene.longest();
    const auto place = size_t(&c - scene.captures.data());
    const Segments segments{c.motion.period_s, c.motion.band_Hz};
    const auto lines = [&](const Eigen::VectorXd& y) {
        return transfer(c.model_torque, y, c.motion.grid.step_s, segments);
    };
    const auto part = [&](const TransferLine& line) {
        return 100 * (against == Against::in_phase ? line.response.real() : line.response.imag());
    };
    std::vector<double> x, r, t;
    for (const TransferLine& line : lines(residual[place]))
        x.push_back(line.frequency_Hz), r.push_back(part(line));
    for (const TransferLine& line : lines(taken[place]))
        t.push_back(part(line));
    return {{"x", numbers(x)}, {"residual", numbers(r)}, {"effect_torque", numbers(t)}};
}

} // namespace

Json candidate_views(const Diagnosis& diagnosis, const Scene& scene,
                     const std::vector<PreparedMotion>& motions) {
    const Vectors residual = residuals_of(scene);
    Json out = Json::array();
    for (const Candidate& candidate : diagnosis.candidates) {
        if (!candidate.fitted) continue;
        if (out.size() == kMost) break;
        const Against against = find_effect(candidate.effect)->info().picture.against;
        const Vectors taken = taken_by(candidate, residual, motions);
        const bool lines = against == Against::in_phase || against == Against::quadrature;
        Json view = lines ? over_lines(against, scene, residual, taken)
                          : over_bins(against, scene, residual, taken);
        const VariableName name = name_of(against, scene);
        view["effect"] = candidate.effect;
        view["against"] = name.name;
        view["against_unit"] = name.unit;
        view["value"] = against == Against::in_phase     ? "in phase"
                        : against == Against::quadrature ? "a quarter of a turn off"
                                                         : "mean torque";
        view["value_unit"] = lines ? "% of torque" : scene.unit(Quantity::torque);
        out.push_back(view);
    }
    return out;
}

} // namespace servoid
