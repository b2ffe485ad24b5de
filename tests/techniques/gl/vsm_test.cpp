// Variance shadow maps against their closed forms: an edge is a ramp, a second occluder a leak.
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/filtered_scenes.h"
#include "tests/support/models/vsm.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using models::chebyshevBound;
using models::Moments;
using techniques::boxFilter;
using techniques::freeRim;

/// Ground metres per texel, with the rim that a prefiltered map leaves free.
double texelOf(const Scene& scene, int map, int kernel) { return texelOf(scene, map - 2 * freeRim(boxFilter(kernel))); }

TEST(Vsm, AnEdgeIsARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const int kernel : {3, 7}) {
        const auto points = groundPoints(stage, rendered(stage, "vsm:map=256,kernel=" + std::to_string(kernel)));
        EXPECT_LT(fromRamp(points, kernel * texelOf(scene, 256, kernel)), 0.03) << kernel; // the ground's pixels are finite
    }
    // Over mipmapped texels the edge may lie anywhere in a texel: the ramp's corners are rounder.
    const auto points = groundPoints(stage, rendered(stage, "vsm:map=512,kernel=40"));
    EXPECT_LT(fromRamp(points, 40 * texelOf(scene, 512, 40)), 0.08);
}

TEST(Vsm, AFullyShadowedReceiverIsDarkBehindOneOccluder) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, "vsm:map=256")))
        ASSERT_LT(point.at.x > edgeAt + 0.4 ? point.visibility : 0, 1e-4);
}

TEST(Vsm, LightLeaksAlongTheEdgeOfASecondOccluder) { // what the papers admit
    const double lower = 1.5, upper = 5;
    const Scene scene = stackedScene(lower, upper);
    Stage stage(scene);
    stage.show(0);
    const auto points = groundPoints(stage, rendered(stage, "vsm:map=256"));

    // The shader against its model: with a share p of the kernel beside the upper plate, the moments are those of
    // two depths, neither of them the ground's. Depth 0 is the upper plate's top, depth 1 the slab's lower side.
    const double range = upper + 0.1 + 0.2;
    const auto unit = [&](double y) { return (upper + 0.1 - y) / range; };
    const double low = unit(lower + 0.1), high = unit(upper + 0.1), ground = unit(0);
    const auto leakOf = [&](double p) {
        return chebyshevBound(Moments{p * low + (1 - p) * high, p * low * low + (1 - p) * high * high}, ground, 1e-6);
    };
    double most = 0;
    for (double p = 0; p <= 1; p += 0.001) most = std::max(most, leakOf(p));
    EXPECT_GT(most, 0.2);
    EXPECT_NEAR(brightest(points), most, 0.02);

    EXPECT_NEAR(greyWidth(points), 7 * texelOf(scene, 256, 7), 0.05); // as wide as the upper plate's own penumbra
}

TEST(Vsm, BleedingIsCutOffAndDarkensThePenumbra) {
    const Scene stacked = stackedScene(1.5, 5);
    Stage dark(stacked);
    dark.show(0);
    EXPECT_LT(brightest(groundPoints(dark, rendered(dark, "vsm:map=256,bleeding=0.5"))), 1e-6);

    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const double width = greyWidth(groundPoints(stage, rendered(stage, "vsm:map=256,bleeding=0.5")));
    EXPECT_NEAR(width, 0.5 * 7 * texelOf(scene, 256, 7), 0.04);
}

TEST(Vsm, SlantedSurfacesNeedNoSlopeBias) {
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 2.5, -8.3};
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"vsm:map=256", "vsm:map=256,kernel=20"})
        for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant)))
            ASSERT_EQ(point.visibility, 1) << variant;
}

} // namespace
} // namespace shadowbench
