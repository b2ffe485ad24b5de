// Summed-area variance shadow maps: sums are the box filter's, and a box is exact however wide.
#include "base/temporary_folder.h"
#include "techniques/folder/templates.h"
#include "tests/support/filtered_scenes.h"
#include "tests/support/modern_rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(SatVsm, IsTheBoxFilterOfEveryWidth) {
    const TemporaryFolder folder;
    techniques::writeFromTemplate("vsm", "mine", folder.path() / "mine"); // means over texels one by one
    const techniques::Entry box = techniques::folderEntry(techniques::readTechniqueFolder(folder.path() / "mine"));
    const Scene scene = stackedScene(1.5, 5, 96);
    Stage stage(scene);
    stage.show(0);
    for (const int kernel : {1, 3, 7, 31}) {
        const std::string parameters = fmt::format("map=128,kernel={}", kernel); // a pixel is less than a texel
        const auto technique = box.make(techniques::parseParameters(parameters, box.parameters, box.id));
        stage.render(*technique, 0, 1);
        const auto means = groundPoints(stage, stage.visibility());
        const auto sums = groundPoints(stage, renderedModern(stage, "sat-vsm", parameters));
        ASSERT_EQ(means.size(), sums.size());
        for (std::size_t i = 0; i < means.size(); ++i)
            ASSERT_NEAR(sums[i].visibility, means[i].visibility, 2e-3) << kernel << ", point " << i; // 22 bits
    }
}

TEST(SatVsm, AWideEdgeIsARampWithoutTheRoundCornersOfMipmaps) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto points = groundPoints(stage, renderedModern(stage, "sat-vsm", "map=512,kernel=40"));
    EXPECT_LT(fromRamp(points, 40 * texelOf(scene, 512)), 0.03); // the ground's pixels are finite
}

TEST(SatVsm, AFarCornerOfALargeMapIsAsExactAsTheNearOne) {
    Scene scene = groundScene(128);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    Stage stage(scene);
    stage.show(0);
    for (const GroundPoint& point : groundPoints(stage, renderedModern(stage, "sat-vsm", "map=2048,kernel=3")))
        ASSERT_EQ(point.visibility, 1);
}

} // namespace
} // namespace shadowbench
