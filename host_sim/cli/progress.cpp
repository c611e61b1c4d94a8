#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

namespace servoid::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kShown = 0.3; // s; work that is done sooner needs no line

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

// One pass over the catalogue. Refining makes several: each starts at a smaller share again.
struct Pass {
    Clock::time_point begin = Clock::now();
    double share = 0;
};

void show(Pass& pass, const std::string& effect, double share) {
    if (share < pass.share) pass = {};
    pass.share = share;
    const double seconds = seconds_since(pass.begin);
    if (seconds < kShown) return;
    const double left = seconds * (1 - share) / std::max(share, 0.01);
    std::cerr << fmt::format("\r{:3.0f} %  {:<24} {:>4.0f} s left", 100 * share, effect, left);
    if (share > 0.95) std::cerr << "\r\033[K";
    std::cerr << std::flush;
}

} // namespace

DiagnoseOptions with_progress(const Output& output) {
    DiagnoseOptions options;
    if (!isatty(STDERR_FILENO) || output.quiet) return options;
    const auto pass = std::make_shared<Pass>();
    options.progress = [pass](const std::string& effect, double share) {
        show(*pass, effect, share);
    };
    return options;
}

} // namespace servoid::cli
