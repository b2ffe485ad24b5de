// Shadow width maps against their closed form: the inner half of the penumbra alone.
#include "base/error.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/soft/shadow-width-map/width_passes.h"
#include "tests/support/plate_scenes.h"

#include <cmath>
#include <numbers>

namespace shadowbench {
namespace {

const std::string smoothed = "shadow-width-map:map=1024", widthMap = smoothed + ",spread=distance";

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = widthMap) {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

TEST(ShadowWidthMap, TheInnerHalfOfThePenumbraIsARamp) {
    const std::vector<SlabPoint> points = pointsOf(halfPlaneScene());
    EXPECT_GE(visibilityAt(points, hardEdge), 0.95);
    EXPECT_NEAR(visibilityAt(points, 0.5 * (hardEdge + umbraFrom)), 0.5, 0.05); // a texel is a tenth of the ramp
    EXPECT_LE(visibilityAt(points, umbraFrom), 0.05);
}

TEST(ShadowWidthMap, SmoothingLeavesABellInsideAStraightEdge) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const double passes = figuresOf(stage, smoothed).at("passes");
    const auto points = slabPoints(stage, rendered(stage, smoothed));
    const techniques::LightView view = techniques::fitToScene(scene.light, stage.frame(0, 1).snapshot);
    const auto texel = [&](const glm::dvec3& p) { return techniques::texelAt(view, p, glm::dvec2(1024))->x; };
    const double lit = std::ceil(texel({0.3, 2, 0}) - 0.5) - 0.5; // the middle of the last texel beside the plate
    const double penumbra = 0.375 / halfPlaneTexel(1024), reach = std::sqrt(std::numbers::pi * passes / 3);
    ASSERT_LT(reach, penumbra); // no penumbra is wider
    std::size_t inside = 0;
    for (const SlabPoint& point : points) {
        const double away = texel(point.at) - lit;
        if (away < 1 || away > 12) continue;
        // Sums of few passes are a bell only nearly, and texels are read linearly.
        EXPECT_NEAR(point.visibility, 1 - std::erf(away / std::sqrt(4 * passes / 3)), 0.03) << away;
        ++inside;
    }
    EXPECT_GT(inside, 500U);
}

TEST(ShadowWidthMap, TheRampIsAsWideAsItsOwnOccludersPenumbra) {
    // A texel is a fifth of the ramp, and the edge may lie anywhere in one.
    const auto points = pointsOf(withHigherPlate(halfPlaneScene()), "shadow-width-map:map=512,spread=distance");
    EXPECT_NEAR(visibilityAt(points, 0.5 * (hardEdge + umbraFrom)), 0.5, 0.13);

    // Means, which go no farther, keep the ramp under a small light. They begin in the middle of the texel beside the
    // outline.
    Scene small = withHigherPlate(halfPlaneScene());
    small.light.u *= 0.25;
    small.light.v *= 0.25;
    const double ramp = 0.375 / 4, half = 0.5 * halfPlaneTexel(2048) / ramp; // of a texel
    EXPECT_NEAR(visibilityAt(pointsOf(small, "shadow-width-map:map=2048"), hardEdge + 0.5 * ramp), 0.5 - half, half + 0.02);
}

TEST(ShadowWidthMap, TheOuterHalfIsMissing) { // what the dissertation admits: shadows are too small
    const std::vector<SlabPoint> points = pointsOf(halfPlaneScene());
    for (const SlabPoint& point : points) {
        if (point.at.x < hardEdge - halfPlaneTexel(1024)) {
            EXPECT_EQ(point.visibility, 1) << point.at.x;
        }
    }
    EXPECT_NEAR(penumbraRmsError(points), 0.29, 0.03); // that of any ramp over one half alone
}

TEST(ShadowWidthMap, AStripIsNotWiderThanItself) {
    // From its middle to its edge is a fifth of the penumbra's half.
    EXPECT_NEAR(visibilityAt(pointsOf(stripScene(), "shadow-width-map:map=512,spread=distance"), stripShadowMiddle), 0.8,
                0.05);
}

TEST(ShadowWidthMap, UmbraBeginsWhereTheLightsOwnShapeFits) {
    // The edge runs through the plate's old one at 45° to the light's sides: along its normal a square reaches √2 as far.
    Scene scene = halfPlaneScene();
    const double s = std::sqrt(0.5);
    scene.objects[1] = object(box({8, 0.002, 8}), {0.3 + 4 * s, 2.001, 0.2 - 4 * s}, 45);
    const std::vector<SlabPoint> points = pointsOf(scene);
    const auto inside = [&](double distance) { // along the normal from the hard edge
        return visibilityAround(points, hardEdge + distance * s, 0.2 - distance * s, 0.04);
    };
    const double reach = 0.375 * std::sqrt(2.0);
    EXPECT_NEAR(inside(0.5 * reach), 0.5, 0.08);
    EXPECT_NEAR(inside(0.85 * reach), 0.15, 0.08);
}

TEST(ShadowWidthMap, AnOccluderBehindAnotherOneLosesItsShadow) { // Fig. 2.16: one depth a texel
    Scene scene = halfPlaneScene();
    scene.objects.push_back(plate(0.5, edgeFor(0.5, 0.3))); // its penumbra ends 7 cm from its hard edge, at x = 0.37
    const std::vector<SlabPoint> points = pointsOf(scene);
    EXPECT_LT(visibilityAt(points, hardEdge - 0.03), 0.1);
    // Behind the upper plate's edge the width, 0.1 m, is divided by the upper plate's reach of 0.375 m; in truth it is dark.
    EXPECT_GT(visibilityAt(points, hardEdge + 0.03), 0.5);
}

TEST(ShadowWidthMap, HasAPassForEveryTexelOfTheWidestPenumbra) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto figures = figuresOf(stage, widthMap);
    EXPECT_EQ(figures.at("occluders"), 1);                  // the slab stands before nothing
    const double widest = 0.75 * (1 / 3.998 - 1 / 6.2) * 6; // metres on the slab: from the plate to the slab's lower side
    EXPECT_NEAR(figures.at("passes"), widest / halfPlaneTexel(1024), 1);
}

TEST(ShadowWidthMap, PassesGoAsFarAlongBothAxes) {
    const auto passes = techniques::widthPasses({0.01, 0.025}, 0.2, 256);
    EXPECT_EQ(passes.steps.size(), 20U);
    glm::ivec2 texels(0);
    for (const glm::ivec2& step : passes.steps) texels += step;
    EXPECT_EQ(texels, glm::ivec2(20, 8));
    EXPECT_EQ(passes.reachPerPass, 0.01);
    EXPECT_EQ(techniques::widthPasses({0.01, 0.025}, 9, 256).steps.size(), 256U); // no occluder is wider than the map
}

TEST(ShadowWidthMap, RefusesBadInput) {
    EXPECT_THROW(techniques::parseVariant("shadow-width-map:map=8"), BadInput);
    expectNoAnswerForALine("shadow-width-map");
}

} // namespace
} // namespace shadowbench
