// Single sample soft shadows against their closed forms: right under a straight edge, wrong where more than one edge
// matters.
#include "base/error.h"
#include "tests/support/plate_scenes.h"

namespace shadowbench {
namespace {

using Points = std::vector<SlabPoint>;

Points pointsOf(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

TEST(SingleSample, ThePenumbraUnderAHalfPlaneIsLinear) {
    // What is left are the map's texels, 21 of them across the penumbra.
    EXPECT_LT(penumbraRmsError(pointsOf(halfPlaneScene(), "single-sample")), 0.03);
}

TEST(SingleSample, APenumbraIsAsWideAsSimilarTrianglesSay) {
    for (const double height : {1.0, 3.0}) {
        const Points points = pointsOf(withHigherPlate(halfPlaneAt(height)), "single-sample");
        const double width = 1.5 * height / (6 - height);
        EXPECT_NEAR(widthBetween(points, 0.1, 0.9), 0.8 * width, 0.1 * width) << height; // two texels
    }
}

TEST(SingleSample, TheCornerOfAQuarterPlaneIsTakenForAnEdge) { // the nearest texel knows of one edge only
    const Points points = pointsOf(quarterPlaneScene(), "single-sample");
    EXPECT_NEAR(visibilityAround(points, hardEdge, 0.2), 0.5, 0.06); // ¾ of the light is visible
}

TEST(SingleSample, UnderANarrowStripTheLightOnBothSidesIsNotAdded) {
    // The strip hides a fifth of the light. It reaches a fifth of a penumbra's half to both sides of its middle: ½ (1 −
    // 0.2).
    const Points points = pointsOf(stripScene(), "single-sample");
    EXPECT_NEAR(visibilityAt(points, stripShadowMiddle), 0.4, 0.03);
}

TEST(SingleSample, WhatASurfaceCastsOnItselfIsLost) { // ids: a receiver's own surface is no occluder (2.3.1)
    Scene scene = halfPlaneScene();
    const Mesh slab = *scene.objects[0].levels[0].mesh, plate = *scene.objects[1].levels[0].mesh;
    scene.objects.resize(1);
    // The slab stands at y = −0.1; the plate's place is relative to it.
    scene.objects[0] = object(joined(slab, plate, {10.3, 2.101, 0}), {0, -0.1, 0});
    for (const SlabPoint& point : pointsOf(scene, "single-sample")) EXPECT_EQ(point.visibility, 1);
}

TEST(SingleSample, ALitSurfaceHasNoFalseShadowOfItsOwn) {
    // A coarse map without a bias, on a ball whose facets cut through the depths of its texels.
    Scene scene = halfPlaneScene();
    scene.objects.resize(1);
    scene.objects.push_back(object(sphere(0.5, 1280), {0.2, 0.7, 0.1}));
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const auto shadowed = [&](const std::string& variant) {
        const Image<float> v = rendered(stage, variant);
        std::size_t dark = 0, seen = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (drawn.id[i] != 2) continue;
            ++seen;
            dark += v[i] < 1 ? 1 : 0;
        }
        EXPECT_GT(seen, 300U);
        return dark;
    };
    EXPECT_EQ(shadowed("single-sample:map=256,bias=none"), 0U);
    EXPECT_GT(shadowed("sm-uniform:map=256,bias=none"), 30U); // which has no ids
}

TEST(SingleSample, APenumbraReachesNoFartherThanTheSearchAndIsStillARamp) {
    const double texel = halfPlaneTexel(1024);
    EXPECT_GT(widthBetween(pointsOf(halfPlaneScene(), "single-sample"), 0.01, 0.99), 0.68); // of 0.75
    Points points = pointsOf(halfPlaneScene(), "single-sample:radius=5");
    EXPECT_NEAR(widthBetween(points, 0.01, 0.99), 0.98 * 10 * texel, texel); // five texels to each side
    for (const SlabPoint& point : points) {
        const double ramp = std::clamp(0.5 - (point.at.x - hardEdge) / (10 * texel), 0.0, 1.0);
        EXPECT_NEAR(point.visibility, ramp, 0.1) << point.at.x; // a texel, a fifth of a half of the ramp
    }
}

TEST(SingleSample, RefusesWhatItCannotSearch) {
    EXPECT_THROW(techniques::parseVariant("single-sample:radius=0"), BadInput);
    EXPECT_THROW(techniques::parseVariant("single-sample:radius=128"), BadInput);
    expectNoAnswerForALine("single-sample");
}

} // namespace
} // namespace shadowbench
