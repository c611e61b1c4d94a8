#include "support.hpp"

#include <gtest/gtest.h>

namespace {

TEST(Friction, ClosedForm) {
    sid_friction_t f;
    sid_friction_init(&f);
    const double d = 2e-6, tc = 0.05, w = 0.01; // rated torque, per speed unit
    for (int v : {1000, 5000, 20000, -1000, -7000, -20000})
        for (int i = 0; i < 100; i++)
            sid_friction_step(&f, v,
                              int32_t(std::lround((d * v + (v > 0 ? tc : -tc) + w) * 1048576)));
    sid_friction_result_t r{};
    EXPECT_EQ(r.status, SID_FRICTION_NOT_RUN);
    ASSERT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_OK);
    EXPECT_NEAR(value(r.viscous) / d, 1, 1e-4);
    EXPECT_NEAR(value(r.coulomb) / tc, 1, 1e-4);
    EXPECT_NEAR(value(r.constant_torque) / w, 1, 1e-4);
}

TEST(Friction, AgreesWithLeastSquaresInLongDouble) {
    std::mt19937 random(seed_of("friction"));
    std::normal_distribution<double> noise(0, 3000);
    sid_friction_t f;
    sid_friction_init(&f);
    long double s[2][5] = {}, tt[2] = {};
    for (int i = 0; i < 40000; i++) {
        const int side = int(random() % 2);
        const int32_t v = int32_t(random() % 300000 + 100) * (side ? -1 : 1);
        const int32_t t = int32_t(std::lround(0.3 * v + (side ? -60000 : 50000) + noise(random)));
        sid_friction_step(&f, v, t);
        const long double x[5] = {1, (long double)v, (long double)t, (long double)v * v,
                                  (long double)v * t};
        for (int k = 0; k < 5; k++)
            s[side][k] += x[k];
        tt[side] += (long double)t * t;
    }
    sid_friction_result_t r;
    ASSERT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_OK);
    long double slope[2], offset[2];
    for (int k = 0; k < 2; k++) {
        const long double* q = s[k];
        slope[k] = (q[0] * q[4] - q[1] * q[2]) / (q[0] * q[3] - q[1] * q[1]);
        offset[k] = (q[2] - slope[k] * q[1]) / q[0];
        const long double rest = tt[k] - offset[k] * q[2] - slope[k] * q[4];
        EXPECT_NEAR(value(r.slope[k]) * 1048576 / double(slope[k]), 1, 1e-8);
        EXPECT_NEAR(value(r.offset[k]) * 1048576 / double(offset[k]), 1, 1e-8);
        EXPECT_NEAR(value(r.residual[k]) * 1048576 / double(sqrtl(rest / q[0])), 1, 1e-6);
    }
    EXPECT_NEAR(value(r.coulomb) * 1048576 / double((offset[0] - offset[1]) / 2), 1, 1e-8);
    EXPECT_NEAR(value(r.constant_torque) * 1048576 / double((offset[0] + offset[1]) / 2), 1, 1e-7);
}

TEST(Friction, SaysWhatItCannotKnow) {
    sid_friction_t f;
    sid_friction_result_t r;
    sid_friction_init(&f);
    EXPECT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_NOT_RUN);
    for (int v = 1; v < 1000; v++)
        sid_friction_step(&f, v, 100 + v);
    EXPECT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_ONE_DIRECTION);
    EXPECT_NEAR(value(r.slope[0]) * 1048576, 1, 1e-6);
    for (int i = 0; i < 10; i++)
        sid_friction_step(&f, -500, -600);
    EXPECT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_ONE_SPEED);
    for (int i = 1; i < 500; i++)
        sid_friction_step(&f, -i, 5000);
    EXPECT_EQ(sid_friction_solve(&f, &r), SID_FRICTION_NEGATIVE);
    sid_friction_step(&f, 0, 5);
    EXPECT_EQ(f.dropped, 1u);
}

TEST(Friction, EverySumStaysBelowTwoToThe62) {
    sid_friction_t f;
    sid_friction_init(&f);
    for (int i = 0; i < 70000; i++)
        sid_friction_step(&f, INT32_MIN, INT32_MIN);
    EXPECT_EQ(f.side[1].count, 65535u);
    EXPECT_EQ(f.dropped, 70000u - 65535u);
    EXPECT_EQ(f.clamped, 65535u);
    EXPECT_EQ(f.side[1].speed_square, int64_t(65535) * 8388607 * 8388607);
    EXPECT_LT(f.side[1].product, 1LL << 62);
    EXPECT_EQ(f.side[1].torque, -int64_t(65535) * 8388607);
}

} // namespace
