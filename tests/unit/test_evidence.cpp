// What the diagnosis rests on: errors on unseen blocks, independent residuals, following a
// reference.
#include "compare/compare.hpp"
#include "diagnose/coherence.hpp"
#include "diagnose/evidence.hpp"
#include "plant/simulate.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace servoid;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

namespace {

constexpr unsigned kSeed = 20261122;

Vector noise(Eigen::Index n, std::mt19937& random) {
    std::normal_distribution<double> normal;
    return Vector::NullaryExpr(n, [&] { return normal(random); });
}

std::vector<int> blocks_of(Eigen::Index rows, int blocks) {
    std::vector<int> out;
    for (Eigen::Index i = 0; i < rows; ++i)
        out.push_back(int(i * blocks / rows));
    return out;
}

} // namespace

TEST(HeldOutPower, IsWhatLeavingEachBlockOutGives) {
    std::mt19937 random(kSeed);
    const Eigen::Index n = 240;
    const Matrix x = Matrix::NullaryExpr(n, 3, [&] { return noise(1, random)[0]; });
    const Vector y = noise(n, random);
    const std::vector<int> block = blocks_of(n, 6);
    const std::vector<double> power = held_out_power(x, y, block, 1e-12);
    ASSERT_EQ(power.size(), 6u);
    for (int b = 0; b < 6; ++b) {
        Matrix rest = x;
        Vector target = y;
        for (Eigen::Index i = 0; i < n; ++i)
            if (block[size_t(i)] == b) rest.row(i).setZero(), target[i] = 0;
        const Vector c = rest.householderQr().solve(target);
        const Vector miss = y - x * c;
        double left = 0;
        for (Eigen::Index i = 0; i < n; ++i)
            if (block[size_t(i)] == b) left += miss[i] * miss[i];
        EXPECT_NEAR(power[size_t(b)] / left, 1, 1e-6) << "block " << b << ", seed " << kSeed;
    }
}

TEST(EffectiveCount, IsTheLengthForWhiteNoiseAndFewForALine) {
    std::mt19937 random(kSeed);
    for (Eigen::Index n : {500, 2000, 8000}) {
        const double count = effective_count(noise(n, random));
        std::printf(
            "figure: independent numbers in %ld of white noise = %.0f (asked: within 25 %%)\n",
            long(n), count);
        EXPECT_NEAR(count / double(n), 1, 0.25) << "seed " << kSeed;
    }
    const Vector line =
        Vector::NullaryExpr(4000, [](Eigen::Index i) { return std::sin(0.05 * double(i)); });
    EXPECT_LT(effective_count(line), 40);
}

TEST(CoherentShare, NoiseDoesNotFollowTheReferenceAndFilteredReferenceDoes) {
    const Model model = read_model(std::string(SERVOID_SOURCE_DIR) + "/examples/system1.toml");
    const Experiment experiment = parse_experiment(
        "multisine:from_Hz=3,to_Hz=60,step_Hz=1,amplitude=0.3,periods=6,seed=5,torque_noise=2e-3");
    const std::vector<Capture> captures = {simulate(model, experiment, 3)};
    const std::vector<PreparedMotion> motions = prepare_all(captures, {});
    Assembler assembler(motions);
    std::mt19937 random(kSeed);
    const Vector white = noise(Eigen::Index(assembler.blocks().size()), random);
    const std::optional<double> of_noise = coherent_share(white, motions, assembler.blocks());
    Vector answer(white.size()); // the measured acceleration: the reference through the loop
    Eigen::Index row = 0;
    for (Eigen::Index k = 0; k < motions[0].grid.count; ++k)
        if (motions[0].used[size_t(k)]) answer[row++] = motions[0].acceleration[k];
    const std::optional<double> of_answer = coherent_share(answer, motions, assembler.blocks());
    ASSERT_TRUE(of_noise && of_answer);
    std::printf("figure: share that follows the reference, noise and motion = %.3f, %.3f\n",
                *of_noise, *of_answer);
    EXPECT_LT(*of_noise, 0.05) << "seed " << kSeed;
    EXPECT_GT(*of_answer, 0.8);
    std::vector<Capture> blind = captures;
    blind[0].position_ref.clear();
    const std::vector<PreparedMotion> without = prepare_all(blind, {});
    EXPECT_FALSE(coherent_share(white, without, assembler.blocks()));
}
