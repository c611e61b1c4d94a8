#include "cli/parameters.hpp"

#include "report/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid::cli {

namespace {

constexpr int kName = 34;    // columns; what a name may have where there is room
constexpr int kNumbers = 39; // of value, deviation, unit and what is between them

} // namespace

void print_parameter(const Output& out, const FittedParameter& p, const std::string& unit) {
    const std::string numbers = fmt::format("{:>12.5g} ± {:<9.2g} {}{}", p.estimate.value,
                                            p.estimate.std, unit, p.fixed ? "  (fixed)" : "");
    const int room = out.screen.terminal ? out.screen.columns - kNumbers : kName;
    if (room >= std::min(kName, display_width(p.name)))
        return out.line("  " + padded(p.name, std::min(kName, room)) + " " + numbers);
    out.line("  " + p.name);
    out.line("  " + numbers);
}

void print_parameters(const Output& out, const FitResult& fit, bool ampere) {
    for (const FittedParameter& p : fit.parameters)
        print_parameter(out, p, unit_of(p.quantity, fit.model.motion, ampere));
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
