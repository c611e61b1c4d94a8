#include "diagnose/structure.hpp"

#include "common/error.hpp"
#include "diagnose/twin.hpp"

#include <algorithm>
#include <cmath>

namespace servoid {

namespace {

constexpr double kLeastShare = 0.15; // of the residual's power, and above what noise shows
constexpr double kLeastZ = 3;
constexpr double kLarge = 0.5, kLargeZ = 2; // a share like that may come from a few blocks only
constexpr int kTwins = 2;

// The largest share that a probe of this name explains of twins; 0 where there are none.
double share_in_noise(const FitResult& fitted, const std::string& name, Assembler& assembler) {
    const double noise = fitted.residual.norm() / std::sqrt(double(fitted.residual.size()));
    double most = 0;
    for (int i = 0; i < kTwins; ++i) {
        const auto twins = make_twins({fitted.model, fitted.homing}, assembler.motions(), noise,
                                      301 + unsigned(i));
        if (!twins) return 0;
        Assembler own(twins->motions);
        own.set_artifact(fitted.artifact);
        own.set_homing(fitted.homing);
        try {
            for (const Probe& p : probe_residual(fit(fitted.model, own), own))
                if (p.name == name) most = std::max(most, p.explained);
        } catch (const Refusal&) {
        }
    }
    return most;
}

} // namespace

Structure structure_of(const FitResult& fit, double error, Assembler& assembler) {
    Structure out{probe_residual(fit, assembler), std::nullopt};
    if (out.probes.empty()) return out;
    const Probe& best = out.probes.front();
    const double least_z = best.explained > kLarge ? kLargeZ : kLeastZ;
    if (best.explained < kLeastShare || best.z < least_z) return out;
    if (std::sqrt(best.explained) * error < std::hypot(kSlight, fit.doubt)) return out;
    if (best.explained - share_in_noise(fit, best.name, assembler) < kLeastShare) return out;
    out.evident = best;
    return out;
}

} // namespace servoid
