// Smoothies: the outer penumbra's closed form at edges and corners, and the umbra that never shrinks.
#include "base/error.h"
#include "tests/support/plate_scene.h"
#include "tests/support/soft_scenes.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Smoothie, ThePenumbraIsALinearRampOutsideTheHardShadow) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto points = slabPoints(stage, rendered(stage, "smoothie:map=2048"));
    // α is linear in the light's image, and so is x on a ground parallel to it; a texel is 2 cm long, a twentieth.
    for (double x = 0.06; x < 0.38; x += 0.04)
        EXPECT_NEAR(visibilityAt(points, x), (hardEdge - x) / (hardEdge - litUntil), 0.03) << x;
    for (const SlabPoint& point : points) {
        const double x = point.at.x;
        EXPECT_TRUE(x > litUntil - 0.03 || point.visibility == 1) << x;
        EXPECT_TRUE(x < hardEdge + 0.03 || point.visibility == 0) << x;
    }
    // Any ramp over the outer half errs by ½/√3, as a hard edge does.
    EXPECT_NEAR(penumbraRmsError(points), 0.289, 0.02);
}

TEST(Smoothie, ItsWidthInTheLightsImageGrowsWithOneMinusTheRatioOfDepths) { // course, "Computing Alpha Values"
    for (const double lift : {0.0, 2.0, 6.0}) { // light and plate, and with them the eye, above the slab
        Scene scene = halfPlaneScene();
        scene.light.centre.y += lift;
        scene.objects[1] = object(box({20, 0.002, 40}), {10.3, 2.001 + lift, 0});
        Stage stage(scene);
        stage.show(0);
        const double width = widthBetween(slabPoints(stage, rendered(stage, "smoothie:map=2048")), 0.1, 0.9) / 0.8;
        const double blocker = 4, receiver = 6 + lift, rectangle = 0.75 / 4; // the radius over the plate's depth
        EXPECT_NEAR(width / receiver, rectangle * (1 - blocker / receiver), 0.1 * rectangle * (1 - blocker / receiver));
    }
}

TEST(Smoothie, ACornerIsAQuadBetweenTheRectangles) {
    const Scene scene = plateScene(1);
    Stage stage(scene);
    stage.show(0);
    const double width = platePenumbra(1);
    double worst = 0, corner = 0;
    std::size_t pixels = 0;
    for (const PlatePoint& p : platePoints(scene, stage, rendered(stage, "smoothie"))) {
        // Two triangles from the corner to the rectangles' ends and to the tip, as far out on the diagonal.
        const double alpha = (std::max(p.x, p.z) + (std::sqrt(2.0) - 1) * std::min(p.x, p.z)) / width;
        const double error = std::abs(p.visibility - std::min(1.0, alpha));
        worst = std::max(worst, p.x > 0.01 || p.z > 0.01 || p.x + p.z == 0 ? error : 0.0); // but for the edge's texels
        if (p.x == 0 || p.z == 0 || alpha > 1) continue;
        corner += error;
        ++pixels;
    }
    EXPECT_GT(pixels, 60U);
    EXPECT_LT(corner / static_cast<double>(pixels), 0.02); // a texel, 2 cm on the ground, is 0.08
    EXPECT_LT(worst, 0.15);
}

TEST(Smoothie, HasARectangleForEachEdgeAndAQuadForEachConvexCorner) {
    const Scene scene = plateScene(1);
    Stage stage(scene);
    stage.show(0);
    const auto figures = figuresOf(stage, "smoothie");
    EXPECT_EQ(figures.at("smoothie_edges"), 4 + 4); // the tops of plate and slab
    EXPECT_EQ(figures.at("smoothie_corners"), 4 + 4);
}

TEST(Smoothie, TheUmbraKeepsItsSizeAsTheLightGrows) { // course, "Limitations"
    EXPECT_NEAR(trueLossOfUmbra(), 0.84, 0.02);
    EXPECT_LE(lossOfUmbra("smoothie"), 0.02);
}

TEST(Smoothie, WhereSmoothiesOverlapTheDarkerOneIsKept) { // minimum blending
    expectTheDarkerWhereTwoOverlap("smoothie");
}

TEST(Smoothie, TopsOfCastersAreLitUpToTheirRims) { expectTopsLitUpToTheirRims("smoothie"); }

TEST(Smoothie, RefusesWhatItCannotAnswer) {
    EXPECT_THROW(techniques::parseVariant("smoothie:map=8"), BadInput);
    EXPECT_THROW(techniques::parseVariant("smoothie:width=2"), BadInput);
    Scene scene = halfPlaneScene();
    const techniques::Entry& entry = *techniques::parseVariant("smoothie").entry;
    EXPECT_FALSE(entry.notApplicable(scene));
    scene.light.kind = LightKind::Line;
    EXPECT_EQ(entry.notApplicable(scene), "the penumbra is that of a round light, and a line has no extent across");
}

} // namespace
} // namespace shadowbench
