// Skirts against their closed forms: both halves of the penumbra, as wide as similar triangles say and no wider than the
// skirt.
#include "base/error.h"
#include "tests/support/plate_scenes.h"

namespace shadowbench {
namespace {

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = "skirt:map=1024,passes=8") {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

double passesOf(const Scene& scene, const std::string& variant) {
    Stage stage(scene);
    stage.show(0);
    return figuresOf(stage, variant).at("passes");
}

TEST(Skirt, LightFallsFromOneSideOfThePenumbraToTheOther) {
    const std::vector<SlabPoint> points = pointsOf(halfPlaneScene());
    double before = 1;
    for (double x = -0.1; x < 0.9; x += 0.05) {
        const double v = visibilityAt(points, x, 0.025);
        EXPECT_LE(v, before + 0.01) << x; // where pixels fall in their texels
        before = v;
    }
    EXPECT_EQ(visibilityAt(points, 0.95), 0);
    EXPECT_EQ(visibilityAt(points, -0.15), 1);
}

TEST(Skirt, BothHalvesOfThePenumbraAreThere) {
    EXPECT_LT(penumbraRmsError(pointsOf(halfPlaneScene())), 0.05); // one half alone: 0.29
}

TEST(Skirt, WidthGrowsWithTheDistanceBehindTheOccluder) {
    for (const double height : {1.5, 2.0, 3.0}) {
        const double width = 1.5 * height / (6 - height); // light · (r − b) / b
        const double measured =
            widthBetween(pointsOf(withHigherPlate(halfPlaneAt(height)), "skirt:map=512,passes=3"), 0.1, 0.9) / 0.8;
        EXPECT_NEAR(measured, width, 0.15 * width) << height;
    }
}

TEST(Skirt, NoPenumbraIsWiderThanTheSkirt) { // what the dissertation admits
    const std::string variant = "skirt:map=1024,passes=2";
    const double skirt = passesOf(halfPlaneScene(), variant) * halfPlaneTexel(1024);
    ASSERT_LT(skirt, 0.2); // the penumbra reaches 0.375 m to each side
    const std::vector<SlabPoint> points = pointsOf(halfPlaneScene(), variant);
    EXPECT_NEAR(widthBetween(points, 0.02, 0.98), 2 * skirt, 2 * halfPlaneTexel(1024));
    for (const SlabPoint& point : points) {
        if (std::abs(point.at.x - hardEdge) < skirt + halfPlaneTexel(1024)) continue;
        EXPECT_EQ(point.visibility, point.at.x < hardEdge ? 1 : 0) << point.at.x;
    }
}

TEST(Skirt, PassesGrowWithTheLight) {
    Scene scene = halfPlaneScene();
    // As many as `passes` for a light whose radius is a tenth of the 3.998 m to the plate.
    EXPECT_EQ(passesOf(scene, "skirt:passes=16"), std::round(16 * 0.75 / 0.3998));
    scene.light.u *= 2;
    scene.light.v *= 2;
    EXPECT_EQ(passesOf(scene, "skirt:passes=16"), std::round(16 * 1.5 / 0.3998));
    EXPECT_EQ(passesOf(scene, "skirt:map=32,passes=16"), 32); // no skirt is wider than the map
}

TEST(Skirt, SlantedSurfacesHaveNoEdges) {
    Scene scene = groundScene(96);
    scene.light = {LightKind::Rectangle, {3.5, 7.5, -3.3}, {0, -1, 0}, {0.8, 0.3, 0}, {0, 0.3, 0.8}};
    Stage stage(scene);
    stage.show(0);
    for (const SlabPoint& point : slabPoints(stage, rendered(stage, "skirt"))) ASSERT_EQ(point.visibility, 1) << point.at.x;
}

TEST(Skirt, RefusesBadInput) {
    EXPECT_THROW(techniques::parseVariant("skirt:passes=0"), BadInput);
    EXPECT_THROW(techniques::parseVariant("skirt:edge=0"), BadInput);
    expectNoAnswerForALine("skirt");
}

} // namespace
} // namespace shadowbench
