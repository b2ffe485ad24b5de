// Costs by the clock of a graphics processor. Mesa's rasteriser in software answers with the time of day at which it came to
// a mark, so that everything is tested here but a real card's rates.
#include "harness/measure/device_cost.h"

#include "techniques/catalog.h"
#include "tests/support/stages.h"

#include <algorithm>
#include <gtest/gtest.h>

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

TEST(DeviceCost, OfAllPassesIsTheFrames) {
    const DeviceTimes times = measured("sm-uniform:map=512", {256}).front();
    double sum = 0;
    for (const PassRecord& pass : times.cost.passes) sum += pass.milliseconds.value();
    EXPECT_GT(times.cost.median, 0);
    EXPECT_NEAR(sum, times.cost.median, 0.5 * sum) << "other frames, on a machine that does other work, too";
    EXPECT_EQ(times.cost.processor, 0) << "every pass asks something of the graphics processor";
    EXPECT_GE(times.cost.first.value(), 0);
}

TEST(DeviceCost, OfMoreWorkIsMore) {
    const DeviceTimes cheap = measured("sm-uniform:map=64", {128}).front();
    const DeviceTimes dear = measured("pcf:kernel=7,map=1024", {128}).front();
    EXPECT_GT(dear.cost.ratio, 2 * cheap.cost.ratio) << "to the same frames of sm-uniform";
}

TEST(DeviceCost, TellsWhatOnlyTheProcessorDoes) {
    const DeviceTimes times = measured("volume-zpass", {64}).front();
    EXPECT_GT(times.cost.processor, 0) << "silhouette edges";
}

TEST(DeviceCost, InMotionIsOfWhatACacheSavesWhileNothingMoves) {
    const DeviceTimes times = measured("sm-adaptive", {64}).front();
    const DeviceTimes uncached = measured("sm-adaptive:cache=off", {64}).front();
    EXPECT_GT(times.cost.motion.value() / times.cost.median, 1.2 * uncached.cost.motion.value() / uncached.cost.median);
}

TEST(DeviceCost, IsWrittenIntoTheRecord) {
    const std::vector<DeviceTimes> times = measured("sm-uniform:map=128", {32, 64});
    Record record;
    timing::setTimes(record, times);
    EXPECT_EQ(record.values["cost.time.median"], times[0].cost.median) << "of the smaller image";
    EXPECT_EQ(record.values["cost.motion.time.median"], times[0].cost.motion);
    EXPECT_EQ(record.deviceCosts.size(), 2U);
    EXPECT_FALSE(record.values["cost.time.bare"]);
}

} // namespace
} // namespace shadowbench
