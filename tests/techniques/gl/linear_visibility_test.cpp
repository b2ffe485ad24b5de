// Soft shadow maps for linear lights: smooth with a map at each end, blind between them.
#include "base/error.h"
#include "tests/support/plate_scenes.h"

#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

const std::string twoMaps = "linear-visibility:map=1024";

/// The half-plane's slab under a line as long as the rectangle's side, along `u`.
Scene underALine(Scene scene, const glm::dvec3& u = {1.5, 0, 0}) {
    scene.light = {LightKind::Line, {0.1, 6, 0.2}, {0, -1, 0}, u, {}};
    return scene;
}

std::vector<SlabPoint> pointsOf(const Scene& scene, const std::string& variant = twoMaps) {
    Stage stage(scene);
    stage.show(0);
    return slabPoints(stage, rendered(stage, variant));
}

std::vector<SlabPoint> pointsUnder(const std::vector<Strip>& strips, const std::string& variant = twoMaps) {
    const Scene scene = underALine(stripScene(strips));
    Stage stage(scene);
    stage.show(0);
    return stripPoints(stage, rendered(stage, variant), strips);
}

TEST(LinearVisibility, IsSmoothAcrossAnEdgeWithTwoSamples) {
    std::vector<SlabPoint> points = pointsOf(underALine(halfPlaneScene()));
    // A skin begins and ends half a texel beyond its edges.
    EXPECT_LE(penumbraRmsError(points), 0.03);
    for (SlabPoint& point : points) point.visibility = 0.5;
    EXPECT_NEAR(penumbraRmsError(points), 0.5 / std::sqrt(3), 0.01); // what the two ends see without a visibility map
}

TEST(LinearVisibility, HasNoPenumbraAlongAnEdge) {
    const auto points = pointsOf(underALine(halfPlaneScene(), {0, 0, 1.5}));
    const double texel = halfPlaneTexel(1024);
    for (const SlabPoint& point : points) {
        if (std::abs(point.at.x - hardEdge) < 2 * texel || std::abs(point.at.z - 0.2) > 2) continue;
        EXPECT_EQ(point.visibility, point.at.x < hardEdge ? 1 : 0) << point.at.x;
    }
}

TEST(LinearVisibility, WhatHidesTheMiddleFromNeitherEndIsCountedOnce) { // both ends see the receiver, each less than half
    const std::vector<Strip> strips{{2, 0.05, 0.15}};
    const auto points = pointsUnder(strips);
    EXPECT_NEAR(visibilityAt(points, 0.1), 0.8, 0.04); // a texel of the strip's three is unsure
    EXPECT_LE(rmsErrorWhere(points, [](const SlabPoint& point) { return point.truth < 1; }), 0.05);
}

/// Two strips that leave the middle third of the light to the receivers right below, and hide the rest.
const std::vector<Strip> gap{{2, -0.17, 0.1 - 0.25 / 3}, {2, 0.1 + 0.25 / 3, 0.37}};

TEST(LinearVisibility, IsBlackWhereOnlyTheMiddleIsSeen) { // course, "Sampling the Light Source"; K30
    int between = 0;
    for (const SlabPoint& point : pointsUnder(gap)) {
        if (std::abs(point.at.x - 0.1) > 0.02) continue;
        EXPECT_NEAR(point.truth, 1.0 / 3, 1e-6);
        EXPECT_EQ(point.visibility, 0);
        ++between;
    }
    EXPECT_GT(between, 20);
}

TEST(LinearVisibility, SeesTheMiddleOfASubdividedLight) { // the course's cure
    const auto points = pointsUnder(gap, twoMaps + ",samples=3");
    EXPECT_NEAR(visibilityAt(points, 0.1), 1.0 / 3, 0.04); // a texel's share of the gap
    EXPECT_LE(penumbraRmsError(pointsOf(underALine(halfPlaneScene()), twoMaps + ",samples=3")), 0.03);
}

/// Texels on the outlines of that plate and slab as seen from x: all sides of the plate, and those of the slab that it does
/// not hide. The map's view ends where the plate ends, and with the slab at the left.
double outlineTexels(double x, double side) {
    constexpr double away = 6 - 2.002; // of the plate
    const double left = (x + 6) / 6, edge = (x - 0.3) / away, right = (20.3 - x) / away, high = 40 / away;
    const double column = side / (left + right), row = side / high;
    const double plate = 2 * (edge + right) * column + 2 * high * row, slab = 2 * (left - edge) * column + 12.0 / 6 * row;
    return plate + slab;
}

TEST(LinearVisibility, ASkinHasAQuadForEachTexelOfAnOutline) {
    Scene scene = underALine(halfPlaneScene());
    scene.light.centre.z = 0; // edges are parallel to the maps' rows and columns
    Stage stage(scene);
    stage.show(0);
    const double texels = outlineTexels(0.1 - 0.75, 1024) + outlineTexels(0.1 + 0.75, 1024);
    EXPECT_NEAR(figuresOf(stage, twoMaps).at("skins"), texels, 0.02 * texels);
}

TEST(LinearVisibility, ASteepSideIsNoDiscontinuity) {
    const Scene scene = underALine(steepSideScene());
    Stage stage(scene);
    stage.show(0);
    const Image<float> v = rendered(stage, twoMaps);
    const metrics::Drawn drawn = stage.drawn();
    int side = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] != 2 || p.z < -0.301 || p.y < 0.1 || p.y > 1.9 || std::abs(p.x - 0.1) > 0.7) continue;
        EXPECT_EQ(v[i], 1) << p.x << ", " << p.y;
        ++side;
    }
    EXPECT_GT(side, 100);
    // The outlines of the slab, which fills the maps, and of the box: its top's back and ends, and those of its front side.
    const double texels = 4 * 1024 + (1.5 / 4 + 2 * 1.0 / 4 + 2 * (0.5 / 4 - 0.5 / 6)) * 1024 / 2;
    EXPECT_NEAR(figuresOf(stage, twoMaps).at("skins"), 2 * texels, 0.06 * texels);
}

TEST(LinearVisibility, WhatNothingHidesIsLitWhole) {
    Scene scene = underALine(groundScene(96));
    scene.objects.push_back(object(sphere(0.5, 500), {-5, 0.6, -5})); // a shadow, but far from the middle
    for (const SlabPoint& point : pointsOf(scene)) {
        if (point.at.x < -3 || point.at.z < -3) continue;
        EXPECT_EQ(point.visibility, 1) << point.at.x << ", " << point.at.z;
    }
}

TEST(LinearVisibility, IsForLinearLights) {
    const auto reason = techniques::parseVariant("linear-visibility").entry->notApplicable(halfPlaneScene());
    EXPECT_EQ(reason.value_or(""), "interpolates between the ends of a linear light; the light of test is a rectangle");
    EXPECT_FALSE(
        techniques::parseVariant("linear-visibility").entry->notApplicable(underALine(halfPlaneScene())).has_value());
}

TEST(LinearVisibility, RefusesBadInput) {
    for (const char* wrong : {"linear-visibility:samples=1", "linear-visibility:samples=17", "linear-visibility:map=8"})
        EXPECT_THROW(techniques::parseVariant(wrong), BadInput) << wrong;
}

} // namespace
} // namespace shadowbench
