// Sample instants from arrivals: lost, repeated and late frames of a bus with a known truth.
#include "can/bus_clock.hpp"
#include "common/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>

using namespace servoid;
using namespace servoid::can;

namespace {

constexpr double kPeriod_s = 1e-3;

struct Bus {
    unsigned seed = 1;
    int cycles = 5000;
    double wait_s = 0; // mean of an exponential wait for the bus
    double lost = 0, repeated = 0;
    double drift = 0; // of the log's clock over the drive's
};

struct Arrived {
    std::vector<double> time_s;
    std::vector<long> cycle;
};

Arrived arrivals_of(const Bus& bus) {
    std::mt19937 random(bus.seed);
    std::exponential_distribution<double> wait(bus.wait_s > 0 ? 1 / bus.wait_s : 1);
    std::uniform_real_distribution<double> chance(0, 1);
    Arrived out;
    double last = 0;
    for (int k = 0; k < bus.cycles; ++k) {
        if (k > 0 && chance(random) < bus.lost) continue;
        const double waits = bus.wait_s > 0 ? wait(random) : 0;
        const double time = std::max(last, (0.3 + k * kPeriod_s) * (1 + bus.drift) + waits);
        const int copies = chance(random) < bus.repeated ? 2 : 1;
        for (int i = 0; i < copies; ++i)
            out.time_s.push_back(time + i * 1e-5), out.cycle.push_back(k);
        last = out.time_s.back();
    }
    return out;
}

// Frames that stand in another cycle than most say.
long wrong_cycles(const FittedClock& clock, const Arrived& truth) {
    std::map<long, long> ahead;
    for (std::size_t i = 0; i < truth.cycle.size(); ++i)
        ++ahead[clock.cycle[i] - truth.cycle[i]];
    long most = 0;
    for (const auto& [by, count] : ahead)
        most = std::max(most, count);
    return long(truth.cycle.size()) - most;
}

} // namespace

TEST(BusClock, AnEvenBusIsExact) {
    const Arrived a = arrivals_of({});
    const FittedClock clock = fit_clock(a.time_s, {});
    EXPECT_NEAR(clock.period_s, kPeriod_s, 1e-12);
    EXPECT_NEAR(clock.start_s, 0.3, 1e-9);
    EXPECT_EQ(wrong_cycles(clock, a), 0);
    EXPECT_LT(clock.jitter_s, 1e-9);
}

// A frame whose six successors all wait as well is taken for a later one, and a repeated frame
// hides one that was lost shortly before: only a SYNC or a counter tells these apart.
TEST(BusClock, FindsLostFramesAndRepeatedOnesOnABusThatWaits) {
    for (const double lost : {0.0, 0.01})
        for (const double repeated : {0.0, 0.01}) {
            long wrong = 0, all = 0;
            for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
                const Arrived a =
                    arrivals_of({.seed = seed, .wait_s = 1e-4, .lost = lost, .repeated = repeated});
                const FittedClock clock = fit_clock(a.time_s, {});
                wrong += wrong_cycles(clock, a), all += long(a.cycle.size());
                EXPECT_NEAR(clock.period_s / kPeriod_s, 1, 3e-6) << "seed " << seed;
            }
            std::printf("figure: %g lost, %g repeated: %ld of %ld frames in a wrong cycle\n", lost,
                        repeated, wrong, all);
            EXPECT_LT(double(wrong), (lost > 0 && repeated > 0 ? 0.005 : 0.001) * double(all));
        }
}

// The clock of a PC is off by some 50 parts in a million.
TEST(BusClock, FollowsTheDriftOfTheLog) {
    const Arrived a = arrivals_of({.cycles = 200000, .wait_s = 5e-5, .lost = 1e-3, .drift = 5e-5});
    const FittedClock clock = fit_clock(a.time_s, {});
    EXPECT_EQ(wrong_cycles(clock, a), 0);
    EXPECT_NEAR(clock.period_s / kPeriod_s - 1, 5e-5, 1e-7);
}

TEST(BusClock, ALateFrameIsNoLostOne) {
    Arrived a = arrivals_of({});
    for (std::size_t i = 100; i < 104; ++i) // they wait for each other
        a.time_s[i] = a.time_s[103] + 1e-5 * double(i) - 1e-5 * 103;
    const FittedClock clock = fit_clock(a.time_s, {});
    EXPECT_EQ(wrong_cycles(clock, a), 0);
    EXPECT_NEAR(clock.latest_s, 3e-3, 1e-4);
}

TEST(BusClock, FewerThanEightAreRefused) {
    EXPECT_THROW(fit_clock(arrivals_of({.cycles = 7}).time_s, {}), Refusal);
    EXPECT_THROW(fit_clock(std::vector<double>(20, 0.5), {}), Refusal);
}

TEST(BusClock, CountersAreUnrolled) {
    EXPECT_EQ(unrolled({254, 255, 0, 1, 1, 0, 2, 129}, 8),
              (std::vector<long>{254, 255, 256, 257, 257, 256, 258, 385}));
    EXPECT_EQ(unrolled({65535, 0}, 16), (std::vector<long>{65535, 65536}));
}
