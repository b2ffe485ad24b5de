// Layered variance shadow maps: the leak of plain ones is gone, and back where occluders share the receiver's layer.
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/filtered_scenes.h"
#include "tests/support/models/lvsm.h"
#include "tests/support/models/vsm.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

constexpr double lower = 1.5, upper = 5; // heights of the two plates

TEST(Lvsm, LayersRemoveTheLeakOfASecondOccluder) {
    const Scene scene = stackedScene(lower, upper);
    Stage stage(scene);
    stage.show(0);
    EXPECT_GT(brightest(groundPoints(stage, rendered(stage, "vsm:map=256"))), 0.25);
    EXPECT_LT(brightest(groundPoints(stage, rendered(stage, "lvsm:map=256"))), 1e-4); // the least variance
}

TEST(Lvsm, OneLayerIsAVarianceShadowMap) {
    const Scene scene = stackedScene(lower, upper);
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "lvsm:map=256,layers=1"), rendered(stage, "vsm:map=256"));
}

TEST(Lvsm, OccludersInTheReceiversLayerStillLeak) { // what the paper admits
    using namespace models;
    using namespace techniques;
    const Scene scene = stackedScene(lower, upper);
    Stage stage(scene);
    stage.show(0);
    const double leak = brightest(groundPoints(stage, rendered(stage, "lvsm:map=256,layers=2")));

    const auto unit = [&](double y) { return (upper + 0.1 - y) / (upper + 0.3); }; // as for vsm
    const DepthLayer layer = depthLayer(1, 2, 0.2);
    ASSERT_EQ(layerOf(unit(0), 2), 1);
    const double low = layerDepth(layer, unit(lower + 0.1)), ground = layerDepth(layer, unit(0));
    double most = 0; // the upper plate is clamped to 0
    for (double p = 0; p <= 1; p += 0.001) most = std::max(most, chebyshevBound({p * low, p * low * low}, ground, 1e-6));
    EXPECT_GT(most, 0.05);
    EXPECT_NEAR(leak, most, 0.02);
}

TEST(Lvsm, AnEdgeIsARampOfTheKernelsWidthInEveryLayer) {
    using namespace models;
    using namespace techniques;
    for (const double height : {1.2, 2.5, 5.0}) { // the ground lies deep in the range or close to the middle
        const Scene scene = edgeScene(height);
        Stage stage(scene);
        stage.show(0);
        for (const char* layers : {"2", "4", "7"}) {
            const auto points = groundPoints(stage, rendered(stage, std::string("lvsm:map=256,layers=") + layers));
            EXPECT_LT(fromRamp(points, 7 * texelOf(scene, 256 - 2 * freeRim(boxFilter(7)))), 0.03)
                << height << ", " << layers;
        }
    }
}

TEST(Lvsm, SurfacesThatCrossLayersStayLit) {
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 2.5, -8.3};
    Stage stage(scene);
    stage.show(0);
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, "lvsm:map=256,layers=5")))
        ASSERT_EQ(point.visibility, 1);
}

TEST(Lvsm, LayersCostMemory) { // what the paper admits
    const auto bytes = [](const std::string& variant) {
        const std::uint64_t before = testContext().tally().bytes;
        const techniques::Variant parsed = techniques::parseVariant(variant);
        const auto technique = parsed.entry->make(parsed.parameters);
        return static_cast<double>(testContext().tally().bytes - before);
    };
    EXPECT_GT(bytes("lvsm:layers=8"), 4 * bytes("lvsm:layers=1")); // the depth map is needed once
}

} // namespace
} // namespace shadowbench
