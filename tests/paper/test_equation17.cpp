// Eq. (17): the poles of the loop, with both readings of the paper's D, and the simulated ring.
#include "paper/paper.hpp"
#include "plant/drive.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace servoid;
using namespace servoid::paper;

namespace {

struct Ring {
    double frequency_Hz = 0, damping = 0;
};

// Roots of J s³ + (D+K_vj) s² + K_vj(K_p+1/T_i) s + K_p K_vj/T_i by the companion matrix; eq. (18).
Ring ring_of(double inertia, double viscous) {
    const double kvj = 40 * kTurn * kInertia1, kp = 40, ti = 4 / (40 * kTurn);
    const double a2 = (viscous + kvj) / inertia, a1 = kvj * (kp + 1 / ti) / inertia,
                 a0 = kp * kvj / ti / inertia;
    Eigen::Matrix3d companion;
    companion << 0, 0, -a0, 1, 0, -a1, 0, 1, -a2;
    for (const std::complex<double>& root : companion.eigenvalues())
        if (root.imag() > 0) return {root.imag() / kTurn, -root.real() / std::abs(root)};
    return {};
}

void expect_ring(const std::string& what, const Ring& ring, double frequency_Hz, double damping) {
    figure("eq. (17), " + what,
           fmt::format("{:.3f} Hz, damping {:.4f}", ring.frequency_Hz, ring.damping),
           fmt::format("{} Hz, {}", frequency_Hz, damping));
    EXPECT_NEAR(ring.frequency_Hz, frequency_Hz, 0.05);
    EXPECT_NEAR(ring.damping, damping, 0.005);
}

TEST(Equation17, System1) { expect_ring("system 1", ring_of(kInertia1, 0.75e-4), 11.9, 0.83); }

TEST(Equation17, System2WithTheDOfSectionIIIF) {
    expect_ring("system 2, D = 0.96e-4", ring_of(kInertia2, 0.96e-4), 10.7, 0.19);
}

TEST(Equation17, System2WithTheDOfTableII) {
    expect_ring("system 2, D = 0.96e-3", ring_of(kInertia2, 0.96e-3), 9.84, 0.295);
}

// The simulated loop's answer to a small step: the axis of eq. (6) with D alone, a fine encoder.
std::vector<double> step_response(double viscous, int every, int count) {
    Model model = with_bits(without(without(system(2), "coulomb"), "elastic_load"), 24);
    for (EffectTerm& term : model.effects)
        term.parameters["coefficient"] = viscous;
    SimulatedDrive drive(model, {});
    std::vector<double> out;
    for (int i = 0; i < every * count; ++i) {
        const double position = drive.step(0.1).position;
        if (i % every == 0) out.push_back(position - 0.1);
    }
    return out;
}

// Three poles from y[k] = c1 y[k-1] + c2 y[k-2] + c3 y[k-3], least squares.
Ring ring_in(const std::vector<double>& y, double step_s) {
    const auto n = Eigen::Index(y.size()) - 3;
    const Eigen::Map<const Eigen::VectorXd> all(y.data(), Eigen::Index(y.size()));
    Eigen::MatrixXd past(n, 3);
    for (int lag = 1; lag <= 3; ++lag)
        past.col(lag - 1) = all.segment(3 - lag, n);
    const Eigen::Vector3d c = past.colPivHouseholderQr().solve(all.tail(n));
    Eigen::Matrix3d companion;
    companion << c[0], c[1], c[2], 1, 0, 0, 0, 1, 0;
    for (const std::complex<double>& z : companion.eigenvalues()) {
        const std::complex<double> s = std::log(z) / step_s;
        if (z.imag() > 0) return {s.imag() / kTurn, -s.real() / std::abs(s)};
    }
    return {};
}

// The sampled loop differs from the equation by its half sample of hold and half of difference:
// 125 µs at 10.7 Hz turn by 0.0084, which takes that much off the damping.
TEST(Equation17, TheSimulatedLoopRingsSo) {
    const double asked[][3] = {{0.96e-4, 10.7, 0.19}, {0.96e-3, 9.84, 0.295}};
    for (const auto& [viscous, frequency_Hz, damping] : asked) {
        const Ring ring = ring_in(step_response(viscous, 40, 60), 40 * kSample);
        figure(fmt::format("simulated loop, system 2 without friction and spring, D = {}", viscous),
               fmt::format("{:.3f} Hz, damping {:.4f}", ring.frequency_Hz, ring.damping),
               fmt::format("{} Hz, {}", frequency_Hz, damping));
        EXPECT_NEAR(ring.frequency_Hz, frequency_Hz, 0.15);
        EXPECT_NEAR(ring.damping, damping, 0.02);
    }
}

} // namespace
