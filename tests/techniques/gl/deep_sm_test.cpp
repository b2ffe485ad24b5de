// Deep shadow maps: texels that are partly covered, at every depth on its own.
#include "techniques/gl/counters.h"
#include "tests/support/filtered_scenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Bars of 4 cm, 10 cm apart, along z: six tenths of the light pass between them.
void addFence(Scene& scene, double height) {
    Object bars = object(box({0.04, 0.02, 12}), {0, 0, 0});
    bars.instances.clear();
    for (int i = -28; i <= 28; ++i)
        bars.instances.push_back({glm::translate(glm::dmat4(1), glm::dvec3(0.1 * i + 0.013, height, 0)), 0});
    scene.objects.push_back(std::move(bars));
}

/// The slab under straight light, seen from the side, with fences at these heights.
Scene fenceScene(const std::vector<double>& heights) {
    Scene scene = groundScene(128);
    scene.light = {LightKind::Directional, {}, {0, -1, 0}, {}, {}};
    scene.camera = {{0.3, 0.9, 6}, {0.3, 0, 0}, {0, 1, 0}, 20, 0.5, 40};
    for (const double height : heights) addFence(scene, height);
    return scene;
}

/// Root of the mean squared difference from `expected` over the ground well within the fence's shadow.
double deviation(Stage& stage, const std::string& variant, double expected) {
    double squares = 0, count = 0;
    for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant))) {
        if (std::abs(point.at.x) > 2) continue;
        squares += (point.visibility - expected) * (point.visibility - expected);
        ++count;
    }
    return std::sqrt(squares / count);
}

TEST(DeepSm, AFenceThinnerThanATexelIsTheShareThatPasses) {
    const Scene scene = fenceScene({2});
    Stage stage(scene);
    stage.show(0);
    // A texel of 19 cm holds two bars or one and parts of others: its share differs from the mean by at most half a bar.
    EXPECT_LT(deviation(stage, "deep-sm:map=64,samples=8", 0.6), 0.11);
    EXPECT_GT(deviation(stage, "sm-uniform:map=64", 0.6), 0.4);   // one sample a texel: lit or not
    EXPECT_GT(deviation(stage, "pcf:map=64,kernel=2", 0.6), 0.2); // the same samples, interpolated
}

TEST(DeepSm, EveryDepthHasItsOwnShare) {
    Scene scene = fenceScene({1.5});
    scene.objects.push_back(object(box({5, 0.1, 12}), {0, 4, 0})); // above the fence: the ground is dark
    Stage dark(scene);
    dark.show(0);
    for (const GroundPoint& point : groundPoints(dark, rendered(dark, "deep-sm:map=64,samples=8")))
        ASSERT_LT(std::abs(point.at.x) < 2 ? point.visibility : 0, 1e-6);

    scene.objects.back() = object(box({5, 0.1, 12}), {0, 1.2, 0}); // below it: its top is in the fence's shadow
    scene.camera.eye = {0.3, 1.4, 6};
    scene.camera.target = {0.3, 1.25, 0};
    Stage between(scene);
    between.show(0);
    const metrics::Drawn drawn = between.drawn();
    const Image<float> v = rendered(between, "deep-sm:map=64,samples=8");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (p.y < 1.249 || p.y > 1.251 || std::abs(p.x) > 2 || std::abs(p.z) > 4) continue;
        sum += v[i];
        ++count;
    }
    ASSERT_GT(count, 100);
    EXPECT_NEAR(sum / count, 0.6, 0.03);
}

TEST(DeepSm, AnEdgeIsARampOfATexelInterpolated) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const auto points = groundPoints(stage, rendered(stage, "deep-sm:map=128,samples=8,error=0"));
    // The texel that the edge crosses is grey, and the lookup interpolates it with both neighbours.
    EXPECT_LE(greyWidth(points), 2 * texelOf(scene, 128) + 0.02);
    EXPECT_GE(greyWidth(points), texelOf(scene, 128) - 0.02);
    EXPECT_NEAR(middleOf(points), edgeAt, 0.25 * texelOf(scene, 128)); // not quantised to whole texels
}

TEST(DeepSm, SlantedSurfacesStayLit) {
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 2.5, -8.3};
    Stage stage(scene);
    stage.show(0);
    for (const char* variant : {"deep-sm:map=128", "deep-sm:map=64,samples=8"})
        for (const GroundPoint& point : groundPoints(stage, rendered(stage, variant)))
            ASSERT_EQ(point.visibility, 1) << variant;
}

TEST(DeepSm, TheBuildTakesAsManyFragmentsAsItHasSamples) { // what the paper admits
    const Scene scene = edgeScene(2, 64);
    Stage stage(scene);
    stage.show(0);
    const auto fragments = [&](const std::string& variant) {
        gl::WorkMeter meter;
        rendered(stage, variant);
        return static_cast<double>(meter.finish().fragments);
    };
    EXPECT_GT(fragments("deep-sm:map=256,samples=8"), 30 * fragments("sm-uniform:map=256"));
}

} // namespace
} // namespace shadowbench
