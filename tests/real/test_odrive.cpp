// A motor that turned once, one way: nothing about inertia or friction can be answered from it.
#include "common/error.hpp"
#include "identify/friction.hpp"
#include "identify/identify.hpp"
#include "real/measured.hpp"

#include <functional>

using namespace servoid;
using namespace servoid::measured;

namespace {

const std::string path = data_folder() + "/odrive_slow/odrive_slow.csv";

std::string refusal_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Refusal& refusal) {
        EXPECT_EQ(refusal.code(), ExitCode::refused);
        EXPECT_FALSE(refusal.record_instead().empty());
        return refusal.what();
    }
    ADD_FAILURE() << "was answered";
    return "";
}

TEST(Odrive, IdentifyRefuses) {
    SERVOID_SKIP_WITHOUT(path);
    const Capture capture = read_capture(path);
    const std::string why = refusal_of([&] { identify(capture, {}); });
    figure("ODrive, identify", why, "refused, and what to record instead");
    EXPECT_NE(why.find("; record instead: "), std::string::npos);
}

// Even with even times the motion would still be one way only.
TEST(Odrive, IdentifyRefusesOneWayMotion) {
    SERVOID_SKIP_WITHOUT(path);
    Capture capture = read_capture(path);
    capture.uniform = true;
    const std::string why = refusal_of([&] { identify(capture, {}); });
    EXPECT_NE(why.find("one way only"), std::string::npos) << why;
}

TEST(Odrive, FrictionRefuses) {
    SERVOID_SKIP_WITHOUT(path);
    const Capture capture = read_capture(path);
    const std::string why = refusal_of([&] { fit_friction(find_runs(capture, Input::automatic)); });
    figure("ODrive, friction", why, "refused, and what to record instead");
    EXPECT_NE(why.find("; record instead: "), std::string::npos);
}

} // namespace
