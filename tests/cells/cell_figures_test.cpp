// What a cell's record says beside its scores.
#include "harness/cells/scene_cells.h"
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(CellRecord, HasTheFiguresAndTheTexelsOfItsTechnique) {
    CellScene& scene = stillScene("dueling-frusta");
    const Record& volumes = scene.scored("volume-zpass");
    EXPECT_GT(volumes.figures.at("stencil_bytes"), volumes.figures.at("stencil_updates"));
    EXPECT_FALSE(volumes.values["aliasing.median"]);

    const Record &map = scene.scored("sm-uniform"), &half = scene.scored("sm-uniform:map=512");
    EXPECT_TRUE(map.figures.empty());
    ASSERT_TRUE(map.values["aliasing.median"] && half.values["aliasing.median"]);
    EXPECT_EQ(*map.values["aliasing.mapped"], 1); // fitted to the whole scene
    EXPECT_NEAR(*half.values["aliasing.median"], 2 * *map.values["aliasing.median"], 1e-6 * *map.values["aliasing.median"]);
    EXPECT_NEAR(*half.values["aliasing.p95"], 2 * *map.values["aliasing.p95"], 1e-6 * *map.values["aliasing.p95"]);

    const Record& silhouette = scene.scored("sm-silhouette");
    EXPECT_EQ(*silhouette.values["aliasing.median"], *map.values["aliasing.median"]); // the same depth map
    EXPECT_GT(silhouette.figures.at("silhouette_branch"), 0);
}

// Light and camera look at each other there: light-space perspective maps then are uniform ones, as the papers say of
// dueling frusta, and nothing beside the view direction may turn them.
TEST(CellRecord, WarpedMapsOfDuelingFrustaHaveTheTexelsOfUniformOnes) {
    CellScene& scene = stillScene("dueling-frusta");
    const double uniform = scene.scored("sm-uniform").values["aliasing.median"].value();
    const double warped = scene.scored("sm-lispsm").values["aliasing.median"].value();
    EXPECT_NEAR(warped / uniform, 1, 0.1);
}

TEST(CellRecord, AnApproachFillsTheHistory) {
    CellScene& approached = stillScene("turned-camera"); // without its approach
    Scene scene = loadScene("turned-camera", Profile::Gate);
    scene.timeline.still = 60;
    CellScene turned(scene);
    const auto mismatch = [](CellScene& cells) {
        return cells.scored("sm-history:map=256").values.list("stability.by_frame.mismatch");
    };
    const std::vector<double> empty = mismatch(approached), filled = mismatch(turned);
    ASSERT_EQ(empty.size(), 60U);
    ASSERT_EQ(filled.size(), 60U); // the approach is not scored
    EXPECT_LT(filled.front(), 0.8 * empty.front());
    EXPECT_NEAR(filled.back(), empty.back(), 0.0005); // sixty frames later it is forgotten
}

TEST(CellRecord, SaysThatASceneBreaksATechniqueAsExpected) {
    testContext();
    Scene scene = loadScene("contact", Profile::Gate);
    scene.timeline = {1, 0};
    const groundtruth::Cache cache = testCache();
    SceneCells cells(scene, cache, {.seed = 1, .time = false, .images = {}});
    const auto measured = [&](const std::string& variant) {
        const techniques::Variant parsed = techniques::parseVariant(variant);
        Record record = cells.blank(parsed);
        cells.measure(parsed, record, [](double, std::string_view) {});
        return record;
    };
    const Record broken = measured("sm-uniform:bias=constant,units=1600000"), sound = measured("sm-uniform");
    EXPECT_EQ(broken.status, Status::ExpectedFailure);
    EXPECT_EQ(broken.reason.find("leak is expected to lie above"), 0U) << broken.reason;
    EXPECT_TRUE(broken.values["accuracy.leak"]);
    EXPECT_EQ(sound.status, Status::Scored);
    EXPECT_EQ(sound.reason, "");
}

} // namespace
} // namespace shadowbench
