// Percentage-closer filtering against its closed form: a straight edge becomes a ramp as wide as the kernel.
#include "tests/support/filtered_scenes.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Distances in the tests below are read off pixels of about 1 cm of ground.
constexpr double pixel = 0.02;

TEST(Pcf, AnEdgeHasAsManyGreySteps) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    for (const int kernel : {3, 5, 7}) {
        const Image<float> v = rendered(stage, "pcf:map=256,kernel=" + std::to_string(kernel));
        // k taps a texel apart: k − 1 grey levels, each one texel wide.
        EXPECT_NEAR(greyWidth(groundPoints(stage, v)), (kernel - 1) * texelOf(scene, 256), pixel) << kernel;
        for (const GroundPoint& point : groundPoints(stage, v)) {
            const double steps = point.visibility * kernel; // the rows of the kernel agree
            ASSERT_NEAR(steps, std::round(steps), 1e-4);
        }
    }
}

TEST(Pcf, BilinearTwoByTwoIsARampOfOneTexel) {
    const Scene scene = edgeScene(2);
    Stage stage(scene);
    stage.show(0);
    const double texel = texelOf(scene, 256);
    const auto points = groundPoints(stage, rendered(stage, "pcf:map=256,kernel=2"));
    EXPECT_NEAR(greyWidth(points), texel, pixel);

    EXPECT_LT(fromRamp(points, texel), 0.05); // linear from one texel centre to the next
}

TEST(Pcf, PenumbraIsTheSameWidthWhereverTheOccluderIs) { // what the sources admit
    double nearest = 0;
    for (const double height : {1.2, 2.5, 5.0}) {
        const Scene scene = edgeScene(height);
        Stage stage(scene);
        stage.show(0);
        const double width = greyWidth(groundPoints(stage, rendered(stage, "pcf:map=256,kernel=7")));
        if (nearest == 0) nearest = width;
        EXPECT_NEAR(width, nearest, pixel) << height;
    }
}

TEST(Pcf, WideKernelsOverAMidpointMapLeaveSlantedSurfacesLit) {
    Scene scene = groundScene(128);
    scene.light.centre = {9.5, 3.5, -8.3};
    scene.objects.push_back(object(box({1.6, 0.4, 1.2}), {0.13, 1.2, 0.21}));
    Stage stage(scene);
    stage.show(0);
    const auto litShare = [&](const std::string& variant) {
        const auto points = groundPoints(stage, rendered(stage, variant));
        const auto lit = std::count_if(points.begin(), points.end(), [&](const GroundPoint& p) {
            return !meetsBox(p.at, scene.light.centre) && p.visibility > 0.99;
        });
        const auto unshadowed = std::count_if(points.begin(), points.end(),
                                              [&](const GroundPoint& p) { return !meetsBox(p.at, scene.light.centre); });
        return static_cast<double>(lit) / static_cast<double>(unshadowed);
    };
    // What is left grey is the penumbra around the box's shadow.
    EXPECT_GT(litShare("pcf:map=512,kernel=7,depth=midpoint"), 0.95);
    EXPECT_LT(litShare("pcf:map=512,kernel=7,bias=none"), 0.5);
}

} // namespace
} // namespace shadowbench
