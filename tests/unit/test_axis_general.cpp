// The engine for every effect, against an integration by brute force and against the exact engine.
#include "axis_brute_force.hpp"
#include "axis_forced.hpp"
#include "plant/axis.hpp"
#include "plant/axis_engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

using namespace servoid;

namespace {

constexpr double kStep = 125e-6;

using Change = std::function<void(AxisDescription&)>;

struct Feature {
    std::string name;
    Change apply;
    double tolerance; // of the largest velocity and position
};

AxisDescription plain() {
    AxisDescription a;
    a.inertia = 2e-5;
    a.viscous_forward = a.viscous_reverse = 2e-4;
    return a;
}

void coulomb(AxisDescription& a) { a.coulomb_forward = 1.2e-2, a.coulomb_reverse = 0.9e-2; }
void elastic(AxisDescription& a) { a.elastic = ElasticLoad{2000, 3100, 0.05, 0.07}; }

// The laws, as the effects of the catalogue write them.
std::vector<Feature> features() {
    auto law = [](auto f) { return [f](AxisDescription& a) { a.opposing.push_back(f); }; };
    return {
        {"spring", law([](const AxisPoint& p) { return 3 * (p.position - 0.002); }), 1e-6},
        {"hard stop", law([](const AxisPoint& p) {
             return 40 * (p.position - std::clamp(p.position, -0.01, 0.01));
         }),
         2e-5},
        {"gravity", law([](const AxisPoint& p) { return 0.02 * std::sin(p.position + 1); }), 1e-6},
        {"cogging", law([](const AxisPoint& p) { return 0.01 * std::sin(24 * p.position); }), 1e-6},
        {"drag", law([](const AxisPoint& p) { return 1e-4 * p.velocity * std::abs(p.velocity); }),
         1e-6},
        {"disturbance", law([](const AxisPoint& p) { return 0.02 * std::sin(300 * p.time_s); }),
         1e-6},
        {"asymmetric viscous", [](AxisDescription& a) { a.viscous_forward = 3e-3; }, 1e-6},
        {"coulomb", coulomb, 2e-5},
        {"stribeck",
         [](AxisDescription& a) {
             coulomb(a);
             a.sliding_extra.push_back([](double v) { return 4e-3 * std::exp(-v * v / 0.04); });
         },
         5e-5},
        {"load friction", [](AxisDescription& a) { a.load_friction = 0.15; }, 2e-5},
        {"friction drift",
         [](AxisDescription& a) {
             coulomb(a);
             a.friction_factor = [](double t) { return 1 + 0.8 * (1 - std::exp(-t / 0.01)); };
         },
         2e-5},
        {"bristle",
         [](AxisDescription& a) {
             a.bristle = Bristle{20, 1e-2};
         },
         2e-5},
        {"bristle and coulomb",
         [](AxisDescription& a) {
             a.bristle = Bristle{20, 1e-2};
             a.coulomb_forward = a.coulomb_reverse = 5e-3;
             a.friction_factor = [](double) { return 1.3; };
         },
         5e-5},
        {"elastic load", elastic, 1e-5},
        {"elastic load and cogging",
         [](AxisDescription& a) {
             elastic(a), coulomb(a);
             a.opposing.push_back(
                 [](const AxisPoint& p) { return 0.01 * std::sin(24 * p.position); });
         },
         1e-4},
        {"gap",
         [](AxisDescription& a) {
             a.backlash = Gap{0.004, 0.6};
         },
         1e-4},
        {"gap and coulomb",
         [](AxisDescription& a) {
             coulomb(a);
             a.backlash = Gap{0.004, 0.6};
         },
         1e-4},
        {"sprung gap",
         [](AxisDescription& a) {
             elastic(a);
             a.backlash = Gap{0.004, 0};
         },
         1e-4},
        {"sprung gap and coulomb",
         [](AxisDescription& a) {
             elastic(a), coulomb(a);
             a.backlash = Gap{0.004, 0};
         },
         1e-3},
        {"inertia wave",
         [](AxisDescription& a) {
             a.inertia_wave = InertiaWave{0.4, 6, 0.3};
         },
         1e-5},
        {"limit and gain", [](AxisDescription& a) { a.drive.limit = 0.04, a.drive.gain = 1.3; },
         1e-6},
        {"ripple",
         [](AxisDescription& a) {
             a.drive.ripple.push_back([](double x) { return 0.2 * std::sin(30 * x); });
             a.drive.ripple.push_back([](double x) { return 0.1 * std::sin(70 * x + 1); });
         },
         1e-5},
        {"lag and ripple",
         [](AxisDescription& a) {
             a.drive.lag_s = 3e-4;
             a.drive.ripple.push_back([](double x) { return 0.2 * std::sin(70 * x); });
         },
         1e-5},
        {"dead time, lag and ripple",
         [](AxisDescription& a) {
             a.drive.lag_s = 3e-4;
             a.drive.dead_time_s = 2.3 * kStep;
             a.drive.ripple.push_back([](double x) { return 0.2 * std::sin(70 * x); });
         },
         1e-5},
        {"short dead time and ripple",
         [](AxisDescription& a) {
             a.drive.dead_time_s = 0.01 * kStep;
             a.drive.ripple.push_back([](double x) { return 0.2 * std::sin(70 * x); });
         },
         1e-5},
        {"dead time under friction of the load",
         [](AxisDescription& a) {
             a.load_friction = 0.15;
             a.drive.dead_time_s = 1.7 * kStep;
         },
         2e-5},
    };
}

// Twenty milliseconds and more of a strong sine and a faster one, with rests in between.
std::vector<double> excitation(int steps) {
    std::vector<double> out;
    for (int i = 0; i < steps; ++i) {
        const double rest = i % 300 > 240 ? 0.05 : 1;
        out.push_back(rest * (0.06 * std::sin(0.03 * i) + 0.04 * std::sin(0.21 * i + 1)));
    }
    return out;
}

struct Difference {
    double position = 0, velocity = 0;
    double worst() const { return std::max(position, velocity); }
};

// Largest differences over the largest values.
template <class Trajectory>
Difference apart(const Trajectory& a, const std::vector<brute_force::Sample>& b) {
    Difference d;
    double x = 0, v = 0;
    for (size_t i = 0; i < b.size(); ++i) {
        d.position = std::max(d.position, std::abs(a[i].position - b[i].position));
        d.velocity = std::max(d.velocity, std::abs(a[i].velocity - b[i].velocity));
        x = std::max(x, std::abs(b[i].position)), v = std::max(v, std::abs(b[i].velocity));
    }
    d.position /= x, d.velocity /= v;
    return d;
}

template <class AnyAxis>
std::vector<brute_force::Sample> run(AnyAxis& axis, const std::vector<double>& asked) {
    std::vector<brute_force::Sample> out;
    for (double torque : asked) {
        axis.step(torque);
        out.push_back({axis.position(), axis.velocity()});
    }
    return out;
}

} // namespace

TEST(AxisGeneral, EachFeatureIsTheBruteForce) {
    const std::vector<double> asked = excitation(600);
    for (const Feature& feature : features()) {
        AxisDescription a = plain();
        feature.apply(a);
        Forced axis(a);
        const Difference d = apart(run(axis, asked), brute_force::run(a, kStep, asked, 0));
        EXPECT_LT(d.position, feature.tolerance) << feature.name;
        EXPECT_LT(d.velocity, feature.tolerance) << feature.name;
    }
}

TEST(AxisGeneral, RandomCombinationsAreTheBruteForce) {
    const std::vector<double> asked = excitation(300);
    const std::vector<Feature> all = features();
    for (unsigned seed = 1; seed <= 8; ++seed) {
        std::mt19937 random(seed);
        std::string names;
        AxisDescription a = plain();
        for (int i = 0; i < 4; ++i) {
            const Feature& feature = all[random() % all.size()];
            feature.apply(a);
            names += feature.name + "; ";
        }
        const double velocity = random() % 2 ? 3.0 : 0.0;
        Forced axis(a);
        axis.set_state(0, velocity);
        const Difference d =
            apart(run(axis, asked), brute_force::run(a, kStep, asked, velocity, 2000));
        EXPECT_LT(d.worst(), 1e-3) << "seed " << seed << ": " << names;
    }
}

TEST(AxisGeneral, ShorterStepsChangeNothing) {
    const std::vector<double> asked = excitation(600);
    for (const Feature& feature : features()) {
        AxisDescription a = plain();
        feature.apply(a);
        Forced usual(a), fine(a, {64, 1e-13});
        const Difference d = apart(run(usual, asked), run(fine, asked));

        EXPECT_LT(d.worst(), 0.3 * feature.tolerance) << feature.name;
    }
}

TEST(AxisGeneral, LinearFeaturesAreTheExactEngine) {
    std::vector<double> asked = excitation(1500);
    asked.resize(2500, 0.0); // and comes to rest
    const std::vector<Change> parts{
        coulomb,
        elastic,
        [](AxisDescription& a) { a.viscous_forward = 2e-3, a.constant_torque = 4e-3; },
        [](AxisDescription& a) { a.drive.limit = 0.07, a.drive.gain = 1.2; },
        [](AxisDescription& a) { a.drive.lag_s = 4e-4; },
        [](AxisDescription& a) { a.drive.dead_time_s = 3.3 * kStep; }};
    for (unsigned choice = 0; choice < 1u << parts.size(); ++choice) {
        AxisDescription a = plain();
        for (size_t i = 0; i < parts.size(); ++i)
            if (choice >> i & 1) parts[i](a);
        ASSERT_TRUE(is_linear(a));
        Axis exact(a, kStep);
        Forced general(a);
        const Difference d = apart(run(general, asked), run(exact, asked));
        EXPECT_LT(d.worst(), 1e-6) << "choice " << choice;
        if (a.coulomb_forward > 0) {
            EXPECT_EQ(exact.stuck(), general.stuck()) << "choice " << choice;
        }
    }
}

TEST(AxisGeneral, SprungGapOfNoWidthIsEquationSeven) {
    AxisDescription soft = plain();
    soft.elastic = ElasticLoad{2000, 3100, 0.02, 0.02 * 3100 / 2000};
    AxisDescription gap = soft;
    gap.backlash = Gap{1e-9, 0};
    const std::vector<double> asked = excitation(100);
    Axis exact(soft, kStep), general(gap, kStep);
    EXPECT_LT(apart(run(general, asked), run(exact, asked)).worst(), 2e-2);
}
