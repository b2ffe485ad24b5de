// Skirts against their closed forms: both halves of the penumbra, as wide as similar triangles say and no wider than the
// skirt.
#include "base/error.h"
#include "techniques/shared/light_views/light_view.h"
#include "tests/support/plate_scenes.h"

#include <cmath>
#include <numbers>

namespace shadowbench {
namespace {

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = "skirt:map=1024,passes=8") {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

/// Those farther from the slab's own outline than its skirt reaches.
std::vector<SlabPoint> farFromTheOutline(std::vector<SlabPoint> points) {
    std::erase_if(points, [](const SlabPoint& point) { return std::abs(point.at.z - 0.2) > 2; });
    return points;
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

TEST(Skirt, SmoothingLeavesABellOutsideAStraightEdge) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const std::string variant = "skirt:map=512,passes=16,spread=smoothing";
    const double passes = figuresOf(stage, variant).at("passes");
    const auto points = farFromTheOutline(slabPoints(stage, rendered(stage, variant)));
    const techniques::LightView view = techniques::fitToScene(scene.light, stage.frame(0, 1).snapshot);
    const auto texel = [&](const glm::dvec3& p) { return techniques::texelAt(view, p, glm::dvec2(512))->x; };
    const double edge = std::ceil(texel({0.3, 2, 0}) - 0.5) + 0.5; // the middle of the plate's first texel
    const double penumbra = 0.375 / halfPlaneTexel(512), reach = std::sqrt(std::numbers::pi * passes / 3);
    std::size_t outside = 0;
    for (const SlabPoint& point : points) {
        const double away = edge - texel(point.at);
        if (away < 1 || away > 12) continue;
        const double attenuation = std::erfc(away / std::sqrt(4 * passes / 3)), half = 1 - 0.5 / reach;
        const double visible = 0.5 + 0.5 * std::min((half - attenuation) / half * reach / std::min(penumbra, reach), 1.0);
        EXPECT_NEAR(point.visibility, visible, 0.02)
            << away; // sums of passes are a bell only nearly; texels are read linearly
        ++outside;
    }
    EXPECT_GT(outside, 300U);
}

TEST(Skirt, SmoothingDarkensSurfacesAlongTheirOwnOutlines) { // mean attenuation and least depth are those of two edges
    const auto rimError = [](const std::string& variant) {
        return rmsErrorWhere(pointsOf(halfPlaneScene(), variant),
                             [](const SlabPoint& point) { return point.at.z < -5 && point.at.x < litUntil; });
    };
    EXPECT_GT(rimError("skirt:map=512,passes=16,spread=smoothing"), 0.2);
    EXPECT_LT(rimError("skirt:map=512,passes=16"), 0.05);
}

TEST(Skirt, WidthGrowsWithTheDistanceBehindTheOccluder) {
    // Means reach no farther than the root of their number, which must not be so great that the higher plate's depth comes.
    for (const char* variant : {"skirt:map=512,passes=30,spread=smoothing", "skirt:map=512,passes=3"})
        for (const double height : {1.5, 2.0, 3.0}) {
            const double width = 1.5 * height / (6 - height); // light · (r − b) / b
            const auto points = farFromTheOutline(pointsOf(withHigherPlate(halfPlaneAt(height)), variant));
            const double measured = widthBetween(points, 0.1, 0.9) / 0.8;
            EXPECT_NEAR(measured, width, 0.15 * width) << variant << " " << height;
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
