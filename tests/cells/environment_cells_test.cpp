// Cells under an environment light: what is scored, against which truth, and what is refused.
#include "base/error.h"
#include "scene/sky.h"
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

Scene underSky() {
    testContext();
    Scene scene = loadScene("constant-sky", Profile::Gate);
    scene.size = {64, 64};
    scene.referenceSamples = 256;
    return scene;
}

TEST(EnvironmentCells, AreScoredAgainstTheSoftTruthAlone) {
    CellScene cells(underSky());
    const Record& record = cells.scored("none");
    ASSERT_TRUE(record.reference);
    EXPECT_EQ(record.reference->oracle, "povray");
    EXPECT_EQ(record.reference->samples, 256);
    EXPECT_FALSE(record.softReference);
    EXPECT_TRUE(record.values["accuracy.rmse"]);
    EXPECT_FALSE(record.values["accuracy.mismatch"]); // there is no label without a hard shadow
    EXPECT_FALSE(record.values["accuracy.leak"]);
    EXPECT_FALSE(record.values["accuracy.edge_error.mean"]);
    EXPECT_EQ(headline(record)->metric, "rmse");
    EXPECT_EQ(mainTruth(cells.scene(), techniques::parseVariant("none")), Truth::Soft);
}

TEST(EnvironmentCells, HaveNoHardTruth) {
    const Scene scene = underSky();
    EXPECT_EQ(truthsOf(scene.light), std::vector{Truth::Soft});
    try {
        static_cast<void>(referenceRequest(scene, Truth::Hard, 0));
        FAIL() << "there is a hard truth";
    } catch (const BadInput& error) {
        EXPECT_STREQ(error.what(), "scene constant-sky has no hard truth: its light is of kind environment, "
                                   "which has soft");
    }
    Scene point = scene;
    point.light = Light{};
    EXPECT_EQ(truthsOf(point.light), (std::vector{Truth::Hard, Truth::PixelArea}));
    EXPECT_THROW(static_cast<void>(referenceRequest(point, Truth::Soft, 0)), BadInput);
    point.light.kind = LightKind::Disk;
    EXPECT_EQ(truthsOf(point.light), (std::vector{Truth::Hard, Truth::Soft, Truth::PixelArea}));
}

TEST(EnvironmentCells, KeepTheirTruthOnMovingFrames) {
    Scene scene = underSky();
    scene.timeline.moving = 1;
    scene.objects[2].motion.shift.keys = {{0, {0, 0, 0}}, {1, {0.3, 0, 0.1}}};
    CellScene cells(scene);
    EXPECT_TRUE(cells.scored("none").values["stability.flicker.mean"]);
    EXPECT_NE(cells.truths().key(Truth::Soft, 0), cells.truths().key(Truth::Soft, 1));
}

TEST(EnvironmentCells, AreTimedInFramesOfAMapFromTheMeanDirection) {
    const Scene scene = underSky();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(stage.frame(0, 1).hardLight.kind, LightKind::Directional);
    const auto technique = techniques::parseVariant("sm-uniform");
    EXPECT_NO_THROW(stage.render(*technique.entry->make(technique.parameters), 0, 1));
}

} // namespace
} // namespace shadowbench
