// What a cell's record says beside its scores.
#include "tests/support/cell_stage.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(CellRecord, HasTheFiguresAndTheTexelsOfItsTechnique) {
    CellScene& scene = stillScene("dueling-frusta");
    const Record& volumes = scene.scored("volume-zpass");
    EXPECT_GT(volumes.figures.at("stencil_bytes"), volumes.figures.at("stencil_updates"));
    EXPECT_FALSE(volumes.aliasing);

    const Record &map = scene.scored("sm-uniform"), &half = scene.scored("sm-uniform:map=512");
    EXPECT_TRUE(map.figures.empty());
    ASSERT_TRUE(map.aliasing && half.aliasing);
    EXPECT_EQ(map.aliasing->mapped, 1); // fitted to the whole scene
    EXPECT_NEAR(half.aliasing->median, 2 * map.aliasing->median, 1e-6 * map.aliasing->median);
    EXPECT_NEAR(half.aliasing->p95, 2 * map.aliasing->p95, 1e-6 * map.aliasing->p95);

    const Record& silhouette = scene.scored("sm-silhouette");
    EXPECT_EQ(silhouette.aliasing->median, map.aliasing->median); // the same depth map
    EXPECT_GT(silhouette.figures.at("silhouette_branch"), 0);
}

} // namespace
} // namespace shadowbench
