// The combined shadow map method under a half-plane: PCSS's widths, without its bands.
#include "scene/meshes/primitives.h"
#include "tests/support/filtered_scenes.h"
#include "tests/support/soft_scenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

std::vector<SlabPoint> pointsOf(Stage& stage, const std::string& variant) {
    return slabPoints(stage, rendered(stage, variant));
}

TEST(Combined, PenumbraUnderAParallelBlockerIsTheDisksRampOverTheRectanglesWidth) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    const auto points = pointsOf(stage, "combined");
    EXPECT_LT(rmsError(points), 0.06);
    for (const double t : {-0.7, -0.4, 0.0, 0.4, 0.7}) { // the taps fill a disk: a rectangle's ramp would be linear
        const double x = hardEdge - t * (umbraFrom - hardEdge);
        EXPECT_NEAR(visibilityAt(points, x), diskShare(t), 0.03) << x; // 40 points and more, with a noise of 0.06 each
    }
}

/// Where x lies in the true penumbra: −1 at its dark end, 1 at its lit one.
double inPenumbra(double x) { return (hardEdge - x) / (umbraFrom - hardEdge); }

double linearRamp(double t) { return std::clamp(0.5 + 0.5 * t, 0.0, 1.0); }

/// Points of one column of ground, parallel to the edge: how many, their mean visibility and its difference from a ramp.
struct Column {
    int count = 0;
    double visibility = 0, error = 0;
};

/// Columns `width` metres wide: noise moves single points.
std::vector<Column> columnsOf(const std::vector<SlabPoint>& points, double width, double (*ramp)(double) = linearRamp) {
    std::map<int, Column> sums;
    for (const SlabPoint& point : points) {
        Column& column = sums[static_cast<int>(std::floor(point.at.x / width))];
        ++column.count;
        column.visibility += point.visibility;
        column.error += point.visibility - ramp(inPenumbra(point.at.x));
    }
    std::vector<Column> columns;
    for (const auto& [index, sum] : sums) columns.push_back({sum.count, sum.visibility / sum.count, sum.error / sum.count});
    return columns;
}

/// The width in metres in which visibility lies between 20 % and 80 % under a rectangle of the sides u and v.
double widthUnder(const glm::dvec3& u, const glm::dvec3& v) {
    Scene scene = halfPlaneScene();
    scene.light.u = u;
    scene.light.v = v;
    Stage stage(scene);
    stage.show(0);
    double width = 0;
    for (const Column& column : columnsOf(pointsOf(stage, "combined:map=2048"), 0.02))
        if (column.visibility > 0.2 && column.visibility < 0.8) width += 0.02;
    return width;
}

TEST(Combined, ARectangleHasAWidthOfItsOwnAlongEachSide) { // Zápotocký 4.4.1
    // A disk's ramp passes 20 % and 80 % at 0.492 of its radius; (receiver − blocker) / blocker.
    constexpr double perMetre = 0.492 * 2 / 4;
    const glm::dvec3 across(1, 0, 0), along(0, 0, 1);
    for (const auto& [ofAcross, ofAlong] : {std::pair(1.5, 0.5), std::pair(0.5, 1.5)}) {
        const double width = ofAcross * perMetre;
        EXPECT_NEAR(widthUnder(ofAcross * across, ofAlong * along), width, 0.1 * width + 0.02);
        EXPECT_NEAR(widthUnder(ofAlong * along, ofAcross * across), width, 0.1 * width + 0.02);
    }
}

TEST(Combined, HardensAtContact) {
    Scene near = halfPlaneScene();
    near.objects[1] = object(box({20, 0.002, 40}), {10.3, 0.501, 0});
    const Scene far = halfPlaneScene();
    Stage nearStage(near), farStage(far);
    nearStage.show(0);
    farStage.show(0);
    EXPECT_LT(widthBetween(pointsOf(nearStage, "combined"), 0.1, 0.9),
              0.4 * widthBetween(pointsOf(farStage, "combined"), 0.1, 0.9));
}

/// Root mean square over the true penumbra of the mean difference from the taps' own ramp in a column: what repeats along
/// the edge.
double bandsOf(std::vector<SlabPoint> points, double (*ramp)(double)) {
    std::erase_if(points, [](const SlabPoint& point) { return point.truth <= 0 || point.truth >= 1; });
    double squares = 0;
    for (const Column& column : columnsOf(points, 0.01, ramp)) squares += column.count * column.error * column.error;
    return std::sqrt(squares / static_cast<double>(points.size()));
}

TEST(Combined, HasFewerBandsThanPcss) { // with as many taps over the penumbra, which fill a square there
    const Scene scene = halfPlaneScene(192);
    Stage stage(scene);
    stage.show(0);
    const double combined = bandsOf(pointsOf(stage, "combined"), diskShare);
    EXPECT_LT(combined, 0.3 * bandsOf(pointsOf(stage, "pcss:taps=32+32"), linearRamp));
}

TEST(Combined, FusesBlockersOfDifferentDepths) { // what PCSS's source admits, inherited
    // A second plate a metre above the slab whose edge, as seen from the light's centre, is the first one's: the two
    // penumbrae lie over each other, 0.75 m and 0.3 m wide, and the receiver takes one of between.
    Scene scene = halfPlaneScene();
    const double lower = 0.1 + (0.3 - 0.1) * 5 / 4; // x of the ray from the centre through (0.3, 2) at height 1
    scene.objects.push_back(object(box({20, 0.002, 40}), {lower + 10, 1.001, 0}));
    Stage stage(scene);
    stage.show(0);
    double squares = 0;
    int count = 0;
    for (const SlabPoint& point : pointsOf(stage, "combined")) {
        const double limit = point.at.x + (lower - point.at.x) * 6; // light x whose segment grazes the lower edge
        const double lowerVisibility = std::clamp((limit - (0.1 - 0.75)) / 1.5, 0.0, 1.0);
        const double truth = std::min(point.truth, lowerVisibility); // both plates hide the side of larger x
        if (truth <= 0 || truth >= 1) continue;
        squares += (point.visibility - truth) * (point.visibility - truth);
        ++count;
    }
    ASSERT_GT(count, 500);
    EXPECT_GT(std::sqrt(squares / count), 0.05);
}

/// The least visibility within 5 cm of the point below the middle of the plate of the next test.
double leastBelowThePlate(Stage& stage, const std::string& variant) {
    double least = 1;
    int count = 0;
    for (const SlabPoint& point : pointsOf(stage, variant))
        if (std::hypot(point.at.x - 0.1, point.at.z - 0.2) < 0.05) {
            least = std::min(least, point.visibility);
            ++count;
        }
    EXPECT_GT(count, 5);
    return least;
}

TEST(Combined, ASmallCasterThatTheOutermostRingMissesHasNoShadow) {
    // Under a plate that hides a quarter of the light, the middle of it: the light's rim is seen all around.
    Scene scene = halfPlaneScene();
    scene.camera = {{-1.3, 1.6, 2.4}, {0.1, 0, 0.2}, {0, 1, 0}, 40, 0.5, 40};
    scene.objects[1] = object(box({0.25, 0.002, 0.25}), {0.1, 2.001, 0.2});
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(leastBelowThePlate(stage, "combined"), 1);
    EXPECT_NEAR(leastBelowThePlate(stage, "sampled-maps:n=256"), 0.75, 0.05);
}

/// Share of the ball's lit pixels that are darkened, where the map is coarse.
double falseShadow(const std::string& variant) {
    Scene scene = halfPlaneScene();
    scene.objects.resize(1);
    scene.objects.push_back(object(sphere(0.5, 1280), {0.2, 0.7, 0.1}));
    Stage stage(scene);
    stage.show(0);
    const metrics::Drawn drawn = stage.drawn();
    const Image<glm::vec3> normals = stage.normals();
    const Image<float> v = rendered(stage, variant);
    double dark = 0, seen = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 toLight = glm::normalize(scene.light.centre - glm::dvec3(drawn.position[i]));
        if (drawn.id[i] != 2 || glm::dot(glm::dvec3(normals[i]), toLight) < 0.5) continue; // all of the light is above
        ++seen;
        dark += v[i] < 1 ? 1 : 0;
    }
    EXPECT_GT(seen, 150);
    return dark / seen;
}

TEST(Combined, MidpointsNeedNoBias) { // Zápotocký 4.4.2: his /m/
    EXPECT_GT(falseShadow("combined:map=256,bias=none"), 0.2);
    EXPECT_EQ(falseShadow("combined:map=256,bias=none,depth=midpoint"), 0);
    // Under a thin plate the mean of its two sides is the plate.
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_LT(rmsError(pointsOf(stage, "combined:depth=midpoint,bias=none")), 0.06);
}

TEST(Combined, AMidpointOfAnOpenMeshLiesBelowIt) { // what the source admits
    Scene scene = halfPlaneScene();
    const Mesh sheet{{{-10, 0, -20}, {-10, 0, 20}, {10, 0, 20}, {10, 0, -20}}, {{0, 1, 2}, {0, 2, 3}}, false};
    scene.objects[1] = object(sheet, {10.3, 2, 0});
    Stage stage(scene);
    stage.show(0);
    const auto penumbra = [&](const std::string& variant) {
        std::vector<SlabPoint> points = pointsOf(stage, variant);
        std::erase_if(points, [](const SlabPoint& point) { // where the slab ends, the map holds no second surface
            return std::abs(point.at.x - hardEdge) > 0.6 || std::abs(point.at.z) > 3;
        });
        return widthBetween(points, 0.02, 0.98);
    };
    const double truth = umbraFrom - litUntil;
    EXPECT_NEAR(penumbra("combined"), truth, 0.15 * truth);
    // Halfway in 1 / depth between the sheet at depth 4 and the slab at 6: at 4.8, where (6 − b) / b is half as much.
    EXPECT_NEAR(penumbra("combined:depth=midpoint"), 0.5 * truth, 0.1 * truth);
}

TEST(Combined, ASeedIsAnImage) {
    const Scene scene = halfPlaneScene();
    Stage stage(scene);
    stage.show(0);
    EXPECT_EQ(rendered(stage, "combined", 1, 3), rendered(stage, "combined", 1, 3));
    EXPECT_NE(rendered(stage, "combined", 1, 3), rendered(stage, "combined", 1, 4));
}

} // namespace
} // namespace shadowbench
