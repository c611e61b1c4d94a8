#include "node_drive.hpp"

// CiA 301, 7.2.4.3: the bytes of requests and answers.
TEST(Sdo, BytesAreThoseOfTheStandard) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    const auto answer = [&](std::vector<uint8_t> request) {
        const auto a = d.ask(0x605, std::move(request));
        return a ? std::vector<uint8_t>(a->data, a->data + a->length) : std::vector<uint8_t>{};
    };
    using Bytes = std::vector<uint8_t>;
    EXPECT_EQ(answer({0x40, 0x8F, 0x60, 1, 0, 0, 0, 0}), (Bytes{0x43, 0x8F, 0x60, 1, 0, 0, 2, 0}));
    EXPECT_EQ(answer({0x40, 0x76, 0x60, 0, 0, 0, 0, 0}),
              (Bytes{0x43, 0x76, 0x60, 0, 0x7D, 0x02, 0, 0}))
        << "637 mN·m";
    EXPECT_EQ(answer({0x40, 0x17, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4B, 0x17, 0x10, 0, 50, 0, 0, 0}));
    EXPECT_EQ(answer({0x2B, 0x17, 0x10, 0, 100, 0, 0, 0}),
              (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0}));
    EXPECT_EQ(answer({0x22, 0x17, 0x10, 0, 90, 0, 0, 0}), (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0}))
        << "without a size";
    EXPECT_EQ(answer({0x40, 0x01, 0x2A, 99, 0, 0, 0, 0}),
              (Bytes{0x80, 0x01, 0x2A, 99, 0x11, 0x00, 0x09, 0x06}));
    EXPECT_EQ(answer({0x21, 0x01, 0x2A, 1, 8, 0, 0, 0}),
              (Bytes{0x80, 0x01, 0x2A, 1, 0x01, 0x00, 0x04, 0x05}))
        << "segmented";
    EXPECT_EQ(answer({0x80, 0x01, 0x2A, 1, 0, 0, 0, 0}), Bytes{}) << "an abort asks nothing";
    EXPECT_EQ(answer({0x40, 0x01, 0x2A}), Bytes{}) << "too short";
}

TEST(Objects, WrongWritesGetTheirCode) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    EXPECT_EQ(d.write(0x2A03, 1, 1, 1), SID_SDO_STATE) << "not claimed";
    EXPECT_EQ(d.write(0x2A01, 4, 1, 4), SID_SDO_STATE);
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    EXPECT_EQ(d.write(0x2A01, 1, 78, 4), SID_SDO_STATE) << "claimed by another";
    EXPECT_EQ(d.write(0x2A03, 1, 5, 1), SID_SDO_RANGE) << "more legs than there is room for";
    EXPECT_EQ(d.write(0x2A03, 1, 1, 2), SID_SDO_LENGTH);
    EXPECT_EQ(d.write(0x2A03, 8, 5, 1), SID_SDO_RANGE) << "no such method";
    EXPECT_EQ(d.write(0x2A03, 9, 0, 4), SID_SDO_NO_SUB);
    EXPECT_EQ(d.write(0x2A05, 1, 0, 4), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x2A05, 1, 4000000000U, 4), SID_SDO_RANGE) << "half the rate";
    EXPECT_EQ(d.write(0x2A05, 5, 1000000, 4), SID_SDO_NO_SUB);
    EXPECT_EQ(d.write(0x2A06, 1, 1U << 30, 4), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x2A02, 1, 0, 1), SID_SDO_READ_ONLY);
    EXPECT_EQ(d.write(0x2B00, 1, 0, 4), SID_SDO_NO_OBJECT);
    EXPECT_EQ(d.write(0x2A01, 3, 0, 4), SID_SDO_RANGE) << "a move of nothing";
    EXPECT_EQ(d.write(0x2A01, 6, 2, 1), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x1016, 1, 127U << 16, 4), SID_SDO_RANGE) << "the watch cannot be turned off";
    EXPECT_EQ(d.refusal(0x2B00, 0), SID_SDO_NO_OBJECT);
    EXPECT_EQ(d.refusal(0x2A05, 1), SID_SDO_WRITE_ONLY);
    EXPECT_EQ(d.refusal(0x2A14, 1), SID_SDO_NO_OBJECT) << "a fifth result";
    EXPECT_EQ(d.refusal(0x2A10, 22), SID_SDO_NO_SUB);
}

// Whatever a master writes, the guards stay within what the drive was configured with.
TEST(Objects, LimitsAreTightenedAndNeverWidened) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    EXPECT_EQ(d.write(0x2A04, 2, 60001, 4), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x2A04, 1, (3 << 20) + 1, 4), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x2A04, 1, 0x80000000U, 4), SID_SDO_RANGE);
    EXPECT_EQ(d.write(0x2A04, 2, 500, 4), 0U);
    EXPECT_EQ(d.value_at(0x2A04, 2), 500U);
    EXPECT_EQ(d.write(0x2A04, 2, 0, 4), 0U) << "back to the configuration";
    EXPECT_EQ(d.value_at(0x2A04, 2), 60000U);
}

TEST(Objects, TheSameStartTwiceStartsOnce) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    d.plan_one(100, 0.05, 9);
    d.step(50);
    const uint32_t began = d.value_at(0x2A02, 10);
    EXPECT_EQ(d.write(0x2A01, 4, 9, 4), 0U) << "the answer was lost, the start comes again";
    EXPECT_EQ(d.write(0x2A01, 4, 10, 4), SID_SDO_STATE);
    EXPECT_EQ(d.write(0x2A03, 1, 1, 1), SID_SDO_STATE) << "no plan is changed under way";
    d.run_out();
    EXPECT_EQ(d.write(0x2A01, 4, 9, 4), 0U);
    d.step(5);
    EXPECT_EQ(d.value_at(0x2A02, 1), uint32_t(SID_STATE_DONE));
    EXPECT_EQ(d.value_at(0x2A02, 10), began);
    EXPECT_EQ(d.write(0x2A01, 4, 10, 4), 0U);
    d.step(5);
    EXPECT_EQ(d.value_at(0x2A02, 1), uint32_t(SID_STATE_MEASURING));
}

TEST(Objects, AMasterThatIsSilentLosesItsClaim) {
    NodeDrive d;
    ASSERT_TRUE(d.begin());
    ASSERT_EQ(d.write(0x2A01, 1, 77, 4), 0U);
    d.step(799, false);
    EXPECT_EQ(d.write(0x2A01, 1, 78, 4), SID_SDO_STATE);
    d.step(10, false);
    EXPECT_EQ(d.write(0x2A01, 1, 78, 4), 0U);
}
