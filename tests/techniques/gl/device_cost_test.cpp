// Costs by the clock of a graphics processor. Mesa's rasteriser in software answers with the time of day at which it came to
// a mark, so that everything is tested here but a real card's rates.
#include "harness/measure/device_cost.h"

#include "techniques/catalog.h"
#include "tests/support/stages.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <thread>
#include <utility>

namespace shadowbench {
namespace {

using timing::DeviceMeter;
using timing::DeviceTimes;

const PassRecord& passNamed(const DeviceCost& cost, std::string_view name) {
    return *std::ranges::find(cost.passes, name, &PassRecord::name);
}

std::vector<DeviceTimes> measured(const std::string& variant, const timing::Screens& screens) {
    testContext();
    return DeviceMeter().measure(boxScene(64), techniques::parseVariant(variant), 0, 1, screens);
}

TEST(DeviceCost, IsOfTheImagesThatAreAskedFor) {
    const std::vector<DeviceTimes> times = measured("sm-uniform:map=128", {32, 128});
    ASSERT_EQ(times.size(), 2U);
    EXPECT_EQ(times[0].cost.width, 32);
    EXPECT_EQ(times[1].cost.height, 128);
    const auto small = static_cast<double>(passNamed(times[0].cost, "resolve").fragments);
    const auto large = static_cast<double>(passNamed(times[1].cost, "resolve").fragments);
    EXPECT_NEAR(large, 16 * small, 0.2 * large) << "what grows with the screen";
    EXPECT_EQ(passNamed(times[0].cost, "depth map").fragments, passNamed(times[1].cost, "depth map").fragments);
}

/// Frames that last so long at least, whatever else the machine does: a sleep is never shorter.
struct Sleeper {
    int first = 150, standing = 30, other = 10, moved = 100, base = 20; // ms; `other` is a second pass
    bool isFirst = true, isMoved = false;

    void draw(techniques::PassListener& listener) {
        const int main = std::exchange(isFirst, false) ? first : isMoved ? moved : standing;
        pass(listener, "main", main);
        pass(listener, "other", other);
    }

    timing::MeasuredFrames frames() {
        const auto drawn = [this](techniques::PassListener& listener) { draw(listener); };
        return {.standing = drawn,
                .base = [this] { sleep(base); },
                .forget = [this] { isFirst = true; },
                .leave = [this] { isMoved = true; },
                .stand = [this] { isMoved = false; },
                .moved = drawn};
    }

    /// As of a technique that reads back: the rasteriser's clock is read when it comes to a mark.
    static void sleep(int milliseconds) {
        gl::Context::current().finish();
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        gl::Context::current().finish();
    }
    static void pass(techniques::PassListener& listener, const char* name, int milliseconds) {
        listener.begin(name);
        sleep(milliseconds);
        listener.end(name);
    }
};

TEST(DeviceCost, TellsStandingMovingAndFirstFramesApart) {
    testContext();
    Sleeper sleeper;
    const DeviceTimes times = DeviceMeter().measure(sleeper.frames(), 64, 32);
    const DeviceCost& cost = times.cost;
    EXPECT_EQ(cost.width, 64);
    EXPECT_EQ(cost.height, 32);
    EXPECT_GE(cost.median, 40);
    EXPECT_LT(cost.median, cost.motion.value());
    EXPECT_GE(cost.motion.value(), 110);
    EXPECT_LT(cost.motion.value(), cost.first.value());
    EXPECT_GE(cost.first.value(), 160);
    EXPECT_GT(cost.ratio, 1.2) << "40 ms to 20";
    EXPECT_GT(times.motionRatio, 1.5 * cost.ratio) << "110 ms to 20";
    EXPECT_FALSE(sleeper.isMoved) << "all is as before";
}

TEST(DeviceCost, SplitsAFrameByPass) {
    testContext();
    Sleeper sleeper;
    const DeviceCost cost = DeviceMeter().measure(sleeper.frames(), 64, 32).cost;
    EXPECT_GE(passNamed(cost, "main").milliseconds.value(), 30);
    EXPECT_GE(passNamed(cost, "other").milliseconds.value(), 10);
    EXPECT_LT(passNamed(cost, "other").milliseconds.value(), passNamed(cost, "main").milliseconds.value());
    EXPECT_GE(cost.processor, 40) << "neither pass draws";
}

TEST(DeviceCost, HasNeitherMotionNorFirstFrameWhereThereIsNone) {
    testContext();
    Sleeper sleeper;
    timing::MeasuredFrames frames = sleeper.frames();
    frames.forget = frames.leave = frames.stand = {};
    frames.moved = {};
    const DeviceCost cost = DeviceMeter().measure(frames, 64, 32).cost;
    EXPECT_FALSE(cost.motion);
    EXPECT_FALSE(cost.first);
}

TEST(DeviceCost, TellsWhatOnlyTheProcessorDoes) {
    const DeviceTimes times = measured("volume-zpass", {64}).front();
    EXPECT_GT(times.cost.processor, 0) << "silhouette edges";
}

TEST(DeviceCost, IsWrittenIntoTheRecord) {
    const std::vector<DeviceTimes> times = measured("sm-uniform:map=128", {32, 64});
    Record record;
    timing::setTimes(record, times);
    EXPECT_EQ(record.values["cost.time.median"], times[0].cost.median) << "of the smaller image";
    EXPECT_EQ(record.values["cost.motion.time.median"], times[0].cost.motion);
    EXPECT_EQ(record.deviceCosts.size(), 2U);
}

} // namespace
} // namespace shadowbench
