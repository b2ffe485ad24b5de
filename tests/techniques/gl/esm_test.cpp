// Exponential shadow maps against their closed forms: an edge far above the ground is a ramp, a near one is transparent.
#include "techniques/filtered/prefiltered_map.h"
#include "tests/support/filtered_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Esm, AnEdgeIsARampOfTheKernelsWidth) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    using namespace techniques;
    const auto points = groundPoints(stage, rendered(stage, "esm:map=256"));
    EXPECT_LT(fromRamp(points, 7 * texelOf(scene, 256 - 2 * freeRim(boxFilter(7)))), 0.03);
}

TEST(Esm, ASecondOccluderDoesNotLeak) {
    const Scene scene = stackedScene(1.5, 5);
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(brightest(groundPoints(stage, rendered(stage, "esm:map=256"))), 1e-6);
}

TEST(Esm, AnOccluderNearContactIsTransparent) { // what its authors admit
    const double height = 1.2, highest = 30;
    Scene scene = edgeScene(height);
    scene.objects.push_back(object(box({0.2, 0.2, 0.2}), {-5.5, highest - 0.1, -5.5})); // stretches the depth range
    Stage stage(scene);
    stage.show(0);
    const double gap = (height + 0.1) / (highest + 0.2); // from the plate's top to the ground, of the depth range
    for (const double c : {20.0, 40.0, 80.0}) {
        const auto points = groundPoints(stage, rendered(stage, "esm:map=256,c=" + std::to_string(c)));
        std::size_t shadowed = 0;
        for (const GroundPoint& point : points) {
            if (point.at.x < edgeAt + 0.4) continue; // beside the penumbra
            ++shadowed;
            ASSERT_NEAR(point.visibility, std::exp(-c * gap), 0.005) << c;
        }
        EXPECT_GT(shadowed, 1000U);
    }
    EXPECT_GT(std::exp(-20 * gap), 0.4); // a coarse exponential has lost this shadow
}

TEST(Esm, AKernelThatReachesBehindTheReceiverIsLit) { // the other failure: one far texel outweighs all near ones
    Scene scene = groundScene(192);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0.3, 1.4, 5}, {0.3, 0.6, 0}, {0, 1, 0}, 15, 0.5, 40};
    scene.objects.push_back(object(box({4, 0.2, 12}), {-1.7, 0.5, 0}));    // a table whose edge is the line x = 0.3
    scene.objects.push_back(object(box({4.05, 0.1, 12}), {-1.675, 3, 0})); // a plate above that covers 5 cm more
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const Image<float> exponential = rendered(stage, "esm:map=256"), filtered = rendered(stage, "pcf:map=256,kernel=7");
    const Image<float> remedied = rendered(stage, "esm:map=256,beyond=pcf");
    const double texel = texelOf(scene, 256);
    std::size_t found = 0;
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] != 2 || p.y < 0.599 || p.x < 0.3 - texel || std::abs(p.z) > 4) continue;
        ++found;
        ASSERT_GT(exponential[i], 0.99); // all of it is in shadow, and at most two of seven columns are open
        ASSERT_LT(filtered[i], 0.5);
        ASSERT_LT(remedied[i], 0.5); // the paper's remedy
    }
    EXPECT_GT(found, 50U);
}

TEST(Esm, ComparingDepthsBeyondTheTestLeavesSlantedSurfacesLit) { // whose kernels exceed 1 as well
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 2.5, -8.3};
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"esm:map=256", "esm:map=256,beyond=pcf", "esm:map=256,kernel=20,beyond=pcf"})
        for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant)))
            ASSERT_EQ(point.visibility, 1) << variant;
}

} // namespace
} // namespace shadowbench
