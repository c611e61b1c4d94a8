#include "cli/check_capture.hpp"
#include "cli/diagnose_output.hpp"
#include "cli/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace servoid::cli {

namespace {

void print_best(const Output& out, const Diagnosis& d, bool ampere) {
    if (d.candidates.empty() || !d.candidates.front().sound) return;
    const Candidate& best = d.candidates.front();
    out.line(fmt::format("\n{}: {}", best.effect, best.signature));
    print_parameters(out, best.parameters, d.before.model.motion, ampere);
}

} // namespace

void print_diagnosis(const Output& out, const Diagnosis& d, bool ampere) {
    out.line(fmt::format("{}   torque error {}, noise floor {}, {:.3g} Hz band",
                         verdict_name(d.verdict), percent(d.error_before), percent(d.noise_floor),
                         d.band_Hz));
    out.line(d.advice);
    if (d.next) out.line(d.next->reason);
    out.line("");
    out.line(fmt::format("{:<22} {:>11} {:>9} {:>9}", "effect", "probability", "after", "unseen"));
    for (const Candidate& c : d.candidates) {
        if (!c.fitted) continue;
        out.line(fmt::format("{:<22} {:>11.3f} {:>9} {:>9}   {}", c.effect, c.probability,
                             percent(c.error_after), percent(c.validation_error_after), c.note));
    }
    print_best(out, d, ampere);
    print_cannot_show(out, d.cannot_show);
}

void print_refinement(const Output& out, const Refinement& r, bool ampere) {
    const double top = r.ladder.front().torque_error;
    for (const Rung& rung : r.ladder) {
        const auto length = size_t(std::max(1.0, 40 * rung.torque_error / top));
        out.line(fmt::format(
            "{:<24} {:>8} {:>8}  {}", rung.added.empty() ? "as it was" : "+ " + rung.added,
            percent(rung.torque_error), percent(rung.validation_error), std::string(length, '#')));
    }
    for (const std::string& name : r.removed)
        out.line("- " + name + " (needless in the end)");
    out.line(fmt::format("{:<24} {:>8}\n", "noise floor", percent(r.noise_floor)));
    out.line(std::string(verdict_name(r.verdict)) + "   " + r.last.advice);
    print_parameters(out, r.result, ampere);
    print_cannot_show(out, r.last.cannot_show);
}

} // namespace servoid::cli
