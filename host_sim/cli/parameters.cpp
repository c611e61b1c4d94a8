#include "cli/parameters.hpp"

#include <fmt/format.h>

namespace servoid::cli {

void print_parameters(const Output& out, const FitResult& fit, bool ampere) {
    for (const FittedParameter& p : fit.parameters)
        out.line(fmt::format("  {:<34} {:>12.5g} ± {:<9.2g} {}{}", p.name, p.estimate.value,
                             p.estimate.std, unit_of(p.quantity, fit.model.motion, ampere),
                             p.fixed ? "  (fixed)" : ""));
    for (const std::string& name : fit.at_bound)
        out.line(fmt::format("  {} would come out negative and is held at its bound: something "
                             "else is missing, or it is not there",
                             name));
}

void print_homing(const Output& out, const Zeros& zeros) {
    for (const CaptureZero& z : zeros)
        out.line(fmt::format("not homed      {}: its position zero lies at {:.5g} ± {:.2g} {}",
                             z.file, z.offset.value, z.offset.std, z.unit));
}

} // namespace servoid::cli
