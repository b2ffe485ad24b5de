// What a record has of a frame's passes.
#include "harness/measure/frame_cost.h"
#include "tests/support/stages.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Counted after a first frame, and timed where that is asked for.
Record recordOf(const Scene& scene, const std::string& name, bool timed) {
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant variant = techniques::parseVariant(name);
    const auto technique = variant.entry->make(variant.parameters);
    timing::Sequence frames{*technique, 0, 1};
    timing::settle(stage, frames);
    Record record;
    timing::measureWork(stage, frames, record);
    if (timed) timing::measureTimes(stage, variant, frames, record);
    return record;
}

const PassRecord& passNamed(const std::vector<PassRecord>& passes, const std::string& name) {
    return *std::ranges::find(passes, name, &PassRecord::name);
}

TEST(FrameCost, OfPassesAddsUpToTheFrame) {
    const Record record = recordOf(boxScene(64), "volume-zfail", true);
    double shares = 0;
    std::uint64_t fragments = 0;
    for (const PassRecord& pass : record.passes) {
        shares += pass.share.value();
        fragments += pass.fragments;
    }
    EXPECT_NEAR(shares, 1, 1e-9);
    EXPECT_EQ(static_cast<double>(fragments), record.values["cost.work.fragments"]);
    EXPECT_EQ(record.passes.front().name, "G-buffer");
    EXPECT_EQ(record.passes.back().name, betweenPasses);
    EXPECT_GT(record.values["cost.time.processor"].value(), 0) << "finds the silhouettes";
    EXPECT_GT(record.values["cost.time.ratio"].value(), 0);
}

TEST(FrameCost, HasNoTimesWhereNothingIsTimed) {
    const Record record = recordOf(boxScene(64), "sm-uniform:map=128", false);
    EXPECT_GT(passNamed(record.passes, "depth map").vertices, 0U);
    for (const PassRecord& pass : record.passes) {
        EXPECT_FALSE(pass.milliseconds);
        EXPECT_FALSE(pass.share);
    }
    EXPECT_FALSE(record.values["cost.time.median"]);
}

TEST(FrameCost, IsMeasuredWithoutChangingWhatIsShown) {
    const Scene scene = boxScene(64);
    Stage stage(scene);
    stage.show(0);
    const techniques::Variant variant = techniques::parseVariant("volume-zfail");
    const auto technique = variant.entry->make(variant.parameters);
    timing::Sequence frames{*technique, 0, 1};
    timing::settle(stage, frames);
    const Image<float> before = stage.visibility();
    Record record;
    timing::measureTimes(stage, variant, frames, record);
    stage.redraw();
    stage.render(*technique, 0, 1);
    EXPECT_EQ(stage.visibility(), before);
}

TEST(OtherScreen, ShowsWhatGrowsWithTheScreenAndWhatWithTheMap) {
    const Scene scene = boxScene(256);
    const techniques::Variant variant = techniques::parseVariant("sm-uniform:map=256");
    const OtherScreen other = timing::measureOtherScreen(scene, variant, 0, 1);
    EXPECT_EQ(other.width, 1024);
    EXPECT_EQ(other.height, 1024);
    const std::vector<PassRecord> own = recordOf(scene, "sm-uniform:map=256", false).passes;
    EXPECT_EQ(passNamed(other.passes, "depth map").fragments, passNamed(own, "depth map").fragments);
    const auto sixteen = 16 * static_cast<double>(passNamed(own, "resolve").fragments);
    EXPECT_NEAR(static_cast<double>(passNamed(other.passes, "resolve").fragments), sixteen, 0.02 * sixteen)
        << "up to the blocks of 4 × 4 along the diagonal of the screen's triangle";
    EXPECT_GT(passNamed(other.passes, "resolve").milliseconds.value(), 0);

    EXPECT_EQ(timing::measureOtherScreen(boxScene(1024), variant, 0, 1).width, 256) << "of a large one a small one";
}

} // namespace
} // namespace shadowbench
