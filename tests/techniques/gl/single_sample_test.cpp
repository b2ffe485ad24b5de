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
    EXPECT_LT(penumbraRmsError(pointsOf(halfPlaneScene(), "single-sample:map=1024")), 0.03);
}

TEST(SingleSample, APenumbraIsAsWideAsSimilarTrianglesSay) {
    for (const double height : {1.0, 3.0}) {
        const Points points = pointsOf(withHigherPlate(halfPlaneAt(height)), "single-sample:map=1024");
        const double width = 1.5 * height / (6 - height);
        EXPECT_NEAR(widthBetween(points, 0.1, 0.9), 0.8 * width, 0.1 * width) << height; // two texels
    }
}

TEST(SingleSample, TheCornerOfAQuarterPlaneIsTakenForAnEdge) { // the nearest texel knows of one edge only
    const Points points = pointsOf(quarterPlaneScene(), "single-sample:map=1024");
    EXPECT_NEAR(visibilityAround(points, hardEdge, 0.2), 0.5, 0.06); // ¾ of the light is visible
}

TEST(SingleSample, UnderANarrowStripTheLightOnBothSidesIsNotAdded) {
    // The strip hides a fifth of the light. It reaches a fifth of a penumbra's half to both sides of its middle: ½ (1 −
    // 0.2).
    const Points points = pointsOf(stripScene(), "single-sample:map=1024");
    EXPECT_NEAR(visibilityAt(points, stripShadowMiddle), 0.4, 0.03);
}

TEST(SingleSample, WhatASurfaceCastsOnItselfStaysHard) { // ids: a receiver's own surface is no occluder beside its texel
    Scene scene = halfPlaneScene();
    const Mesh slab = *scene.objects[0].levels[0].mesh, plate = *scene.objects[1].levels[0].mesh;
    scene.objects.resize(1);
    // The slab stands at y = −0.1; the plate's place is relative to it.
    scene.objects[0] = object(joined(slab, plate, {10.3, 2.101, 0}), {0, -0.1, 0});
    std::size_t dark = 0;
    for (const SlabPoint& point : pointsOf(scene, "single-sample:map=1024")) {
        EXPECT_TRUE(point.visibility == 0 || point.visibility == 1) << point.visibility;
        dark += point.visibility == 0 ? 1 : 0;
    }
    EXPECT_GT(dark, 500U);
}

TEST(SingleSample, ASearchEndsAfterItsRadius) {
    const double texel = halfPlaneTexel(1024);
    EXPECT_GT(widthBetween(pointsOf(halfPlaneScene(), "single-sample:map=1024"), 0.01, 0.99), 0.68); // of 0.75
    // Five texels to each side; the last ring may lie a texel further from the receiver's own place in its texel.
    EXPECT_LT(widthBetween(pointsOf(halfPlaneScene(), "single-sample:map=1024,radius=5"), 0.01, 0.99), 12.5 * texel);
}

TEST(SingleSample, RefusesWhatItCannotSearch) {
    EXPECT_THROW(techniques::parseVariant("single-sample:radius=0"), BadInput);
    EXPECT_THROW(techniques::parseVariant("single-sample:radius=128"), BadInput);
    expectNoAnswerForALine("single-sample");
}

} // namespace
} // namespace shadowbench
