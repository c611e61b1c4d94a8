#include "story/views.hpp"

#include <nlohmann/json.hpp>

namespace servoid {

namespace {

constexpr size_t kBins = 40;
constexpr size_t kPoints = 2000;

Json bins_json(const std::vector<MeanBin>& bins) {
    Json out = Json::array();
    for (const MeanBin& b : bins)
        out.push_back({{"from", b.from},
                       {"to", b.to},
                       {"mean", b.mean},
                       {"std", b.std},
                       {"residual_share", b.power_share},
                       {"sample_share", b.count_share}});
    return out;
}

} // namespace

Json against_json(const Scene& scene) {
    const std::vector<Eigen::VectorXd> residuals = residuals_of(scene);
    Json out = Json::array();
    for (const Against against :
         {Against::velocity, Against::position, Against::acceleration, Against::torque}) {
        const std::vector<Point> points = points_against(against, scene, residuals);
        const std::vector<MeanBin> bins = mean_over(points, kBins);
        if (bins.empty()) continue;
        const VariableName name = name_of(against, scene);
        std::vector<double> x, y;
        for (const auto& [place, value] : thinned(points, kPoints))
            x.push_back(place), y.push_back(value);
        out.push_back({{"variable", name.name},
                       {"unit", name.unit},
                       {"bins", bins_json(bins)},
                       {"x", numbers(x)},
                       {"y", numbers(y)}});
    }
    return out;
}

} // namespace servoid
