// EPOS drive 1: friction from constant-speed runs, against least squares in double written here.
#include "identify/friction.hpp"
#include "real/measured.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace servoid;
using namespace servoid::measured;

namespace {

std::vector<std::string> steady_files() {
    std::vector<std::string> out;
    for (const auto& file : std::filesystem::directory_iterator(data_folder() + "/epos_drive1"))
        if (file.path().filename().string().starts_with("steady_")) out.push_back(file.path());
    std::sort(out.begin(), out.end());
    return out;
}

FrictionResult all_runs() {
    std::vector<SpeedRun> runs;
    for (const std::string& file : steady_files())
        for (const SpeedRun& run : find_runs(read_capture(file), Input::automatic))
            runs.push_back(run);
    return fit_friction(runs);
}

struct Means {
    std::vector<double> velocity, torque;
};

Means means_of_runs(const FrictionResult& result) {
    Means out;
    for (const SpeedRun& run : result.runs)
        out.velocity.push_back(run.velocity), out.torque.push_back(run.torque);
    return out;
}

Means means_of_whole_files() {
    const auto mean = [](const std::vector<double>& x) {
        return Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())).mean();
    };
    Means out;
    for (const std::string& file : steady_files()) {
        const Capture c = read_capture(file);
        out.velocity.push_back(mean(c.velocity)), out.torque.push_back(mean(c.torque));
    }
    return out;
}

// Eqs. (10)–(12) of one direction: [slope, offset].
Eigen::Vector2d line_through(const Means& means, int sign) {
    std::vector<double> velocity, torque;
    for (size_t i = 0; i < means.velocity.size(); ++i) {
        if (means.velocity[i] * sign <= 0) continue;
        velocity.push_back(means.velocity[i]), torque.push_back(means.torque[i]);
    }
    Eigen::MatrixXd x = Eigen::MatrixXd::Ones(Eigen::Index(velocity.size()), 2);
    x.col(0) = Eigen::Map<Eigen::VectorXd>(velocity.data(), x.rows());
    return x.colPivHouseholderQr().solve(Eigen::Map<Eigen::VectorXd>(torque.data(), x.rows()));
}

void expect_line(const DirectionFit& core, const Eigen::Vector2d& line, int sign) {
    EXPECT_NEAR(core.viscous.value / line[0], 1, 1e-4);
    EXPECT_NEAR(core.offset.value / (sign * line[1]), 1, 1e-4);
}

void show(const std::string& what, const Estimate& e, const std::string& unit) {
    figure("EPOS drive 1, " + what, fmt::format("{:.4g} ± {:.2g} {}", e.value, e.std, unit),
           "as least squares in double");
}

TEST(Epos, EveryFileIsOneRun) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/epos_drive1");
    const FrictionResult result = all_runs();
    EXPECT_EQ(result.runs.size(), 32u);
    EXPECT_EQ(result.forward.runs, 16);
    EXPECT_EQ(result.reverse.runs, 16);
    long samples = 0;
    for (const SpeedRun& run : result.runs) {
        samples += run.samples;
        const std::string name = std::filesystem::path(run.file).filename();
        const double rpm = std::stod(name.substr(8, 3)) * (name[7] == 'n' ? -1 : 1);
        EXPECT_NEAR(run.velocity * 60 / (2 * std::numbers::pi), rpm, 1 + 0.01 * std::abs(rpm))
            << name;
        EXPECT_GE(run.samples, 16) << name;
    }
    figure("EPOS drive 1, rows that count as steady", fmt::format("{} of 16000", samples), "most");
}

TEST(Epos, BothDirectionsAgreeWithDouble) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/epos_drive1");
    const FrictionResult result = all_runs();
    show("viscous forward", result.forward.viscous, "N·m·s/rad");
    show("viscous reverse", result.reverse.viscous, "N·m·s/rad");
    show("Coulomb forward (Tc + w)", result.forward.offset, "N·m");
    show("Coulomb reverse (Tc − w)", result.reverse.offset, "N·m");
    expect_line(result.forward, line_through(means_of_runs(result), 1), 1);
    expect_line(result.reverse, line_through(means_of_runs(result), -1), -1);
}

// Which samples of a file count as steady is a choice; it must not matter beyond the stated error.
TEST(Epos, WholeFilesGiveTheSameWithinTheStatedError) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/epos_drive1");
    const FrictionResult result = all_runs();
    const Means means = means_of_whole_files();
    for (const int sign : {1, -1}) {
        const DirectionFit& side = sign > 0 ? result.forward : result.reverse;
        const Eigen::Vector2d line = line_through(means, sign);
        figure(
            fmt::format("EPOS drive 1, {}, means of whole files", sign > 0 ? "forward" : "reverse"),
            fmt::format("{:.4g} N·m·s/rad, {:.4g} N·m", line[0], sign * line[1]),
            fmt::format("{:.4g} ± {:.2g}, {:.4g} ± {:.2g} within 2 std", side.viscous.value,
                        side.viscous.std, side.offset.value, side.offset.std));
        EXPECT_LE(std::abs(line[0] - side.viscous.value), 2 * side.viscous.std);
        EXPECT_LE(std::abs(sign * line[1] - side.offset.value), 2 * side.offset.std);
    }
}

TEST(Epos, BothTogetherAreEquations13And14) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/epos_drive1");
    const FrictionResult r = all_runs();
    show("viscous", r.viscous, "N·m·s/rad");
    show("Coulomb", r.coulomb, "N·m");
    show("constant torque", r.constant_torque, "N·m");
    EXPECT_NEAR(r.viscous.value, (r.forward.viscous.value + r.reverse.viscous.value) / 2, 1e-12);
    EXPECT_NEAR(r.coulomb.value, (r.forward.offset.value + r.reverse.offset.value) / 2, 1e-12);
    EXPECT_NEAR(r.constant_torque.value, (r.forward.offset.value - r.reverse.offset.value) / 2,
                1e-12);
    EXPECT_GT(r.viscous.value, 0);
    EXPECT_GT(r.coulomb.value, 0);
}

TEST(Epos, ResidualOfEachRun) {
    SERVOID_SKIP_WITHOUT(data_folder() + "/epos_drive1");
    const FrictionResult r = all_runs();
    double squares = 0, largest = 0;
    for (const SpeedRun& run : r.runs) {
        const DirectionFit& side = run.velocity > 0 ? r.forward : r.reverse;
        const double law =
            side.viscous.value * run.velocity + (run.velocity > 0 ? 1 : -1) * side.offset.value;
        EXPECT_NEAR(run.residual, run.torque - law, 1e-9) << run.file;
        squares += run.residual * run.residual;
        largest = std::max(largest, std::abs(run.residual));
    }
    figure("EPOS drive 1, residual of a run, rms and largest",
           fmt::format("{:.3g}, {:.3g} mN·m", 1e3 * std::sqrt(squares / 32), 1e3 * largest),
           "given per run");
    EXPECT_LT(largest, 0.2 * r.coulomb.value);
}

} // namespace
