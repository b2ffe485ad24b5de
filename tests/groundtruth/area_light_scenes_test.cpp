// The failure scenes of soft shadows are what their first lines say: exact visible fractions at points of their grounds.
#include "scene/load/load.h"
#include "tests/support/area_scenes.h"

#include <string>
#include <vector>

namespace shadowbench::groundtruth::testing {
namespace {

Scene sceneOf(const std::string& id) { return loadScene(id, Profile::Gate); }

double visibleIn(const Scene& scene, const glm::dvec3& point) {
    return visibleAt(snapshot(scene, scene.timeline.still - 1), point);
}

/// The scene under a thousandth of its light's length, `share` of u away from its centre.
Scene underPartOfTheLight(Scene scene, double share) {
    scene.light.centre += share * scene.light.u;
    scene.light.u *= 0.001;
    scene.light.v *= 0.001;
    return scene;
}

Scene without(Scene scene, const std::vector<std::string>& names) {
    std::erase_if(scene.objects, [&](const Object& o) { return std::ranges::find(names, o.name) != names.end(); });
    return scene;
}

/// Points of the ground a quarter of a metre apart.
std::vector<glm::dvec3> groundPoints() {
    std::vector<glm::dvec3> points;
    for (int x = -8; x <= 8; ++x)
        for (int z = -7; z <= 7; ++z) points.emplace_back(0.25 * x + 0.013, 0, 0.25 * z + 0.017);
    return points;
}

TEST(LargeLight, LeavesAnUmbraThatAHalfLargerLightEnds) {
    const Scene scene = sceneOf("large-light");
    const glm::dvec3 middle(0.13, 0, -0.13); // of the plate's hard shadow
    EXPECT_EQ(visibleIn(scene, middle), 0);
    EXPECT_GT(visibleIn(scene, middle + glm::dvec3(0.4, 0, 0)), 0.05); // well within the hard shadow
    Scene larger = scene;
    larger.light.u *= 1.5;
    larger.light.v *= 1.5;
    EXPECT_GT(visibleIn(larger, middle), 0.1);
}

TEST(CubeSilhouette, IsThatOfItsTopFromTheLightsCentreAndNotFromTheWholeLight) {
    const Scene cube = sceneOf("cube-silhouette");
    Scene top = cube; // a sheet where the cube has its upper face
    top.objects[1].levels[0].mesh = std::make_shared<const Mesh>(box({0.83, 1e-4, 0.83}));
    top.objects[1].instances[0].place[3].y += 0.415;
    const Scene cubeFromCentre = underPartOfTheLight(cube, 0), topFromCentre = underPartOfTheLight(top, 0);
    int shadowed = 0;
    double most = 0;
    for (const glm::dvec3& point : groundPoints()) {
        EXPECT_NEAR(visibleIn(cubeFromCentre, point), visibleIn(topFromCentre, point), 1e-9);
        if (visibleIn(cubeFromCentre, point) == 0) ++shadowed;
        most = std::max(most, visibleIn(top, point) - visibleIn(cube, point));
    }
    EXPECT_GT(shadowed, 10);
    EXPECT_GT(most, 0.1);
}

TEST(MiddleGap, ShowsAThirdOfTheLightAndNeitherEnd) {
    const Scene scene = sceneOf("middle-gap");
    const glm::dvec3 below(scene.light.centre.x, 0, scene.light.centre.z);
    for (const double along : {-0.3, 0.0, 0.3}) {
        const glm::dvec3 point = below + glm::dvec3(along, 0, 0);
        EXPECT_NEAR(visibleIn(scene, point), 1 / 3.0, 0.02) << along;
        for (const double end : {-0.499, 0.499}) EXPECT_EQ(visibleIn(underPartOfTheLight(scene, end), point), 0) << along;
    }
}

TEST(StackedPlates, HaveStripsSideBySideFromTheLightsCentreThatOverlapFromElsewhere) {
    const Scene both = without(sceneOf("stacked-plates"), {"upper plate", "lower plate"});
    const Scene upper = without(both, {"lower strip"}), lower = without(both, {"upper strip"});
    const auto hidden = [](const Scene& scene, double x) { return 1 - visibleIn(scene, {x, 0, 0.07}); };

    double overlap = 0;
    for (double x = 0.7; x < 2.7; x += 0.05)
        overlap = std::max(overlap, hidden(upper, x) + hidden(lower, x) - hidden(both, x));
    EXPECT_GT(overlap, 0.25);

    int between = 0; // hundredths of a metre
    for (double x = 1.4; x < 1.7; x += 0.01) {
        const double byUpper = hidden(underPartOfTheLight(upper, 0), x), byLower = hidden(underPartOfTheLight(lower, 0), x);
        EXPECT_LE(byUpper + byLower, 1) << x;
        if (byUpper + byLower == 0) ++between;
    }
    EXPECT_GE(between, 2);
    EXPECT_LE(between, 4);
}

TEST(StackedPlates, HaveALowerPlateThatTheLightsCentreDoesNotSee) {
    const Scene scene = sceneOf("stacked-plates"), single = without(scene, {"lower plate"});
    const Scene sceneFromCentre = underPartOfTheLight(scene, 0), singleFromCentre = underPartOfTheLight(single, 0);
    for (const glm::dvec3& point : groundPoints())
        EXPECT_EQ(visibleIn(sceneFromCentre, point), visibleIn(singleFromCentre, point)) << point.x << " " << point.z;
    const glm::dvec3 below(-1.156, 0, 0.01);
    EXPECT_EQ(visibleIn(scene, below), 0);
    EXPECT_GT(visibleIn(single, below), 0.3);
}

} // namespace
} // namespace shadowbench::groundtruth::testing
