#include "answers/fit_json.hpp"

#include <nlohmann/json.hpp>

namespace servoid {

Json fitted_parameters(const FitResult& fit, bool ampere) {
    Json out = Json::object();
    for (const FittedParameter& p : fit.parameters)
        out[p.name] = parameter(p.estimate.value, p.estimate.std,
                                unit_of(p.quantity, fit.model.motion, ampere));
    return out;
}

Zeros zeros_of(const Homing& homing, const std::vector<Capture>& captures) {
    Zeros out;
    for (size_t i : homing.all_moved())
        out.push_back(
            {captures[i].path, homing.offset[i],
             unit_of(Quantity::position, captures[i].linear ? Motion::linear : Motion::rotary)});
    return out;
}

void add_homing(Json& out, const Zeros& zeros) {
    for (const CaptureZero& z : zeros)
        out["homing"].push_back(
            {{"capture", z.file}, {"offset", parameter(z.offset.value, z.offset.std, z.unit)}});
}

} // namespace servoid
