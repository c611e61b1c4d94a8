#include "compare/loop_view.hpp"

#include "compare/loop_twin.hpp"

#include <cmath>

namespace servoid {

namespace {

// ‖a − b‖/‖a‖; nothing where a is zero.
std::optional<double> relative(const std::vector<double>& a, const std::vector<double>& b) {
    double power = 0, miss = 0;
    for (size_t i = 0; i < a.size(); ++i)
        power += a[i] * a[i], miss += (a[i] - b[i]) * (a[i] - b[i]);
    if (!(power > 0)) return std::nullopt;
    return std::sqrt(miss / power);
}

} // namespace

std::optional<LoopError> loop_view(const Model& model, const Capture& capture) {
    const std::optional<Capture> twin = loop_twin(model, capture);
    if (!twin) return std::nullopt;
    const bool asked = !capture.torque_ref.empty();
    const auto torque = asked ? relative(capture.torque_ref, twin->torque_ref)
                              : relative(capture.torque, twin->torque);
    const auto position = relative(capture.position, twin->position);
    if (!torque || !position) return std::nullopt;
    return LoopError{*torque, *position};
}

} // namespace servoid
