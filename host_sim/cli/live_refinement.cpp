#include "cli/live_refinement.hpp"

#include "cli/check_capture.hpp"
#include "cli/over_time_text.hpp"
#include "cli/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace servoid::cli {

LiveRefinement::LiveRefinement(const Output& output, const std::vector<PreparedMotion>& motions)
    : out_(output), motions_(motions), line_(output) {}

DiagnoseOptions LiveRefinement::options() {
    DiagnoseOptions out;
    if (const Progress progress = line_.progress())
        out.progress = [this, progress](const std::string& what, double share) {
            const size_t rungs = ladder_ ? ladder_->rungs() : 0; // the first pass makes two
            progress(fmt::format("pass {}: {}", std::max<size_t>(1, rungs), what), share);
        };
    if (out_.on_terminal()) out.on_rung = [this](const Refinement& r) { show_rung(r); };
    return out;
}

std::vector<TimePart> LiveRefinement::parts_of(const FitResult& fit) const {
    return residual_over_time(fit.model, fit.homing, motions_, parts_on(out_.screen));
}

void LiveRefinement::show_rung(const Refinement& r) {
    line_.clear();
    if (!ladder_) {
        ladder_.emplace(out_, r.ladder.front().torque_error, r.noise_floor);
        ladder_->print_head();
        before_ = parts_of(r.result);
    }
    ladder_->print(r.ladder.back());
    std::cout << std::flush;
}

void LiveRefinement::show_end(const Refinement& r, const NextCommands& next, bool ampere) {
    line_.clear();
    if (!out_.on_terminal()) return;
    for (const std::string& name : r.removed)
        out_.line(out_.dim("- " + name + " (needless in the end)"));
    out_.line("");
    out_.line(fmt::format("{}  torque error {} → {}, noise floor {}", badge(out_, r.verdict),
                          percent(r.ladder.front().torque_error),
                          out_.bold(percent(r.result.torque_error)), percent(r.noise_floor)));
    out_.line(r.last.advice, 0);
    print_before_and_after(out_, before_, parts_of(r.result));
    out_.line("\nparameters");
    print_parameters(out_, r.result, ampere);
    print_cannot_show(out_, r.last.cannot_show);
    show_next(out_, r.last, next);
}

} // namespace servoid::cli
