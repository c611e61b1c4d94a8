// The stated correlation of parameters against the one that is seen over many records: amplitude,
// order and phase of a wave are made of two coefficients and a shape.
#include "compare/compare.hpp"
#include "compare/regression.hpp"
#include "unit/rigid_axis.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <fmt/format.h>

#include <random>

using namespace servoid;

namespace {

constexpr double kAmplitude = 0.3, kOrder = 4, kPhase = 0.4;

Model with_wave() {
    Model model = rigid_axis(kInertia, kViscous, kOffset);
    model.effects.push_back(
        term("cogging", {{"amplitude", 0.1}, {"order", 1.03 * kOrder}, {"phase", 0}}));
    return model;
}

FitResult fitted_to_noise(unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> gauss(0, 0.05);
    const Capture capture = sampled(
        [&](const Kinematics& k, double) {
            return rigid_torque(k) + kAmplitude * std::sin(kOrder * k.position + kPhase) +
                   gauss(random);
        },
        10, 4e-3);
    return fit(with_wave(), prepare_all({&capture, 1}, {25.0, {}}));
}

Eigen::VectorXd values_of(const FitResult& f) {
    Eigen::VectorXd out(Eigen::Index(f.parameters.size()));
    for (size_t i = 0; i < f.parameters.size(); ++i)
        out[Eigen::Index(i)] = f.parameters[i].estimate.value;
    return out;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
    const Eigen::VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
    return scale.asDiagonal() * covariance * scale.asDiagonal();
}

TEST(ParameterCovariance, IsTheOneOverManyRecords) {
    constexpr unsigned records = 200;
    const FitResult first = fitted_to_noise(1);
    const auto n = Eigen::Index(first.parameters.size());
    ASSERT_EQ(first.parameter_covariance.rows(), n);
    Eigen::MatrixXd stated = Eigen::MatrixXd::Zero(n, n), squares = stated;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (unsigned seed = 1; seed <= records; ++seed) {
        const FitResult f = fitted_to_noise(seed);
        const Eigen::VectorXd values = values_of(f) - values_of(first);
        stated += f.parameter_covariance / records;
        sum += values, squares += values * values.transpose();
        for (Eigen::Index i = 0; i < n; ++i)
            EXPECT_NEAR(std::sqrt(f.parameter_covariance(i, i)),
                        f.parameters[size_t(i)].estimate.std,
                        1e-9 * f.parameters[size_t(i)].estimate.std);
    }
    const Eigen::MatrixXd seen = (squares - sum * sum.transpose() / records) / (records - 1);
    const Eigen::MatrixXd difference = correlation_of(stated) - correlation_of(seen);
    for (Eigen::Index i = 0; i < n; ++i)
        fmt::print("figure: {}: stated over observed std = {:.3f} (asked: 0.8 to 1.3)\n",
                   first.parameters[size_t(i)].name, std::sqrt(stated(i, i) / seen(i, i)));
    fmt::print(
        "figure: correlations of {} parameters: stated less observed at most {:.3f}, strongest "
        "{:.3f}\n",
        n, difference.cwiseAbs().maxCoeff(),
        (correlation_of(seen) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff());
    EXPECT_LT(difference.cwiseAbs().maxCoeff(),
              0.25); // three deviations of 200 records, and blocks
    for (Eigen::Index i = 0; i < n; ++i) {
        const double ratio = std::sqrt(stated(i, i) / seen(i, i));
        EXPECT_GT(ratio, 0.8) << first.parameters[size_t(i)].name;
        EXPECT_LT(ratio, 1.3) << first.parameters[size_t(i)].name;
    }
}

} // namespace
