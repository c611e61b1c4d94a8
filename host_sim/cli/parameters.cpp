#include "cli/parameters.hpp"

#include "report/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid::cli {

namespace {

constexpr int kName = 34;    // columns, in a pipe
constexpr int kNumbers = 39; // of value, deviation, unit and what is between them

std::string numbers_of(const FittedParameter& p, const std::string& unit) {
    return fmt::format("{:>12.5g} ± {:<9.2g} {}{}", p.estimate.value, p.estimate.std, unit,
                       p.fixed ? "  (fixed)" : "");
}

// Of the longest name.
int columns_of(const std::vector<FittedParameter>& parameters) {
    int out = 0;
    for (const FittedParameter& p : parameters)
        out = std::max(out, display_width(p.name));
    return out;
}

} // namespace

void print_parameters(const Output& out, const std::vector<FittedParameter>& parameters,
                      Motion motion, bool ampere) {
    const int room = out.screen.columns - kNumbers;
    const int name = out.screen.terminal ? columns_of(parameters) : kName;
    for (const FittedParameter& p : parameters) {
        const std::string numbers = numbers_of(p, unit_of(p.quantity, motion, ampere));
        if (!out.screen.terminal || name <= room)
            out.line("  " + padded(p.name, name) + " " + numbers);
        else
            out.line("  " + p.name), out.line("  " + numbers);
    }
}

void print_parameters(const Output& out, const FitResult& fit, bool ampere) {
    print_parameters(out, fit.parameters, fit.model.motion, ampere);
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
