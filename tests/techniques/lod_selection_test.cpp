// Which level an instance shows, how much of it is seen, and in which frame.
#include "base/error.h"
#include "harness/measure/lod_cost.h"
#include "harness/render/walk.h"
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "techniques/lod/lod-frame-sequential/alternation.h"
#include "techniques/lod/lod-frame-sequential/visibility_texture.h"
#include "techniques/lod/transition.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::lod {
namespace {

using namespace techniques;

std::vector<Level> threeLevels() {
    const auto mesh = std::make_shared<const Mesh>(box({1, 1, 1}));
    return {{mesh, 10}, {mesh, 20}, {mesh}};
}

TEST(LodSelection, TransitionsLieHalfABandToEachSideOfTheDistanceOfALevel) {
    const auto levels = threeLevels();
    const auto at = [&](double distance) { return select(levels, 0.2, distance); };
    EXPECT_EQ(at(1), (LodSelection{0, 0}));
    EXPECT_EQ(at(8.999), (LodSelection{0, 0}));
    EXPECT_NEAR(at(9.5).progress, 0.25, 1e-12);
    EXPECT_NEAR(at(10).progress, 0.5, 1e-12);
    EXPECT_EQ(at(10).level, 0);
    EXPECT_EQ(at(11.001), (LodSelection{1, 0}));
    EXPECT_EQ(at(20).level, 1);
    EXPECT_NEAR(at(21).progress, 0.75, 1e-12); // the band grows with the distance: 18 to 22
    EXPECT_EQ(at(22.001), (LodSelection{2, 0}));
    EXPECT_EQ(at(1e6), (LodSelection{2, 0}));
    EXPECT_EQ(select({levels.back()}, 0.2, 5), (LodSelection{0, 0}));
}

TEST(LodTransition, TheNewLevelComesInOverTheWholeOldOneThenTheOldOneGoes) { // dissertation Fig. 5.2
    for (const double progress : {0.0, 0.1, 0.3, 0.5, 0.8, 0.99}) {
        const TransitionVisibility v = transitionVisibility(progress);
        EXPECT_EQ(std::max(v.finer, v.coarser), 1) << progress;
        EXPECT_EQ(showsCoarser(progress) ? v.coarser : v.finer, 1) << progress;
        const TransitionVisibility back = transitionVisibility(1 - progress);
        EXPECT_NEAR(v.finer, back.coarser, 1e-12);
    }
    EXPECT_EQ(transitionVisibility(0).coarser, 0);
    EXPECT_EQ(transitionVisibility(0.25).coarser, 0.5);
    EXPECT_EQ(transitionVisibility(0.5).finer, 1);
    EXPECT_EQ(transitionVisibility(0.5).coarser, 1);
    EXPECT_EQ(transitionVisibility(0.75).finer, 0.5);
}

std::vector<LodInstance> instancesAt(std::initializer_list<LodSelection> selections) {
    std::vector<LodInstance> instances;
    for (const LodSelection& selection : selections)
        instances.push_back({static_cast<std::uint32_t>(instances.size() + 1), 0, {}, {}, selection});
    return instances;
}

TEST(LodAlternation, StartsWithTheWholeLevelAndThenAlternates) {
    Alternation alternation;
    const auto instances = instancesAt({{0, 0}, {0, 0.2}, {1, 0.7}});
    for (int frame = 0; frame < 4; ++frame) {
        const auto draws = alternation.next(instances);
        ASSERT_EQ(draws.size(), 3U);
        EXPECT_EQ(draws[0].level, 0);
        EXPECT_EQ(draws[0].id, 0U); // not in transition
        EXPECT_EQ(draws[0].visibility, 1);
        EXPECT_EQ(draws[1].level, frame % 2);
        EXPECT_FLOAT_EQ(draws[1].visibility, frame % 2 == 0 ? 1.0F : 0.4F);
        EXPECT_EQ(draws[2].level, frame % 2 == 0 ? 2 : 1); // the second half: the coarser one is whole
        EXPECT_FLOAT_EQ(draws[2].visibility, frame % 2 == 0 ? 1.0F : 0.6F);
        EXPECT_EQ(draws[2].id, 3U);
    }
}

TEST(LodAlternation, AnInstanceThatWasOutOfViewOrInAnotherTransitionStartsAgain) {
    Alternation alternation;
    const auto inTransition = instancesAt({{0, 0.2}});
    EXPECT_EQ(alternation.next(inTransition)[0].level, 0);
    EXPECT_EQ(alternation.next(inTransition)[0].level, 1);
    EXPECT_TRUE(alternation.next({}).empty()); // culled
    EXPECT_EQ(alternation.next(inTransition)[0].level, 0);
    EXPECT_EQ(alternation.next(instancesAt({{1, 0.2}}))[0].level, 1); // the next transition: whole is its finer level
    alternation.reset();
    EXPECT_EQ(alternation.next(inTransition)[0].level, 0);
}

TEST(VisibilityTexture, ShowsTheShareOfTexelsThatTheThresholdSays) {
    for (const char* pattern : {"noise", "centre-out"}) {
        const Image<std::uint8_t> texture = visibilityTexture(pattern);
        ASSERT_EQ(texture.size(), 64U * 64U);
        for (const double threshold : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
            const auto seen = std::ranges::count_if(texture, [&](std::uint8_t value) { return value <= 255 * threshold; });
            EXPECT_NEAR(static_cast<double>(seen) / 4096, threshold, 1.0 / 255) << pattern;
        }
        EXPECT_EQ(std::ranges::count(texture, 0), 0); // nothing at τ = 0
    }
}

TEST(VisibilityTexture, NoiseHasNoPatternAndTheCentreComesFirst) {
    const Image<std::uint8_t> noise = visibilityTexture("noise"), centre = visibilityTexture("centre-out");
    double sum = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 63; ++x) sum += (noise(x, y) - 128.0) * (noise(x + 1, y) - 128.0);
    // Uniform values 1 … 255 have a variance of 74² = 5419; the mean of 4,032 products of independent ones has a standard
    // deviation of 5419 / 63.5 = 85: four of them.
    EXPECT_LT(std::abs(sum / (63 * 64)), 350);
    EXPECT_EQ(centre(31, 31), 1);
    EXPECT_EQ(centre(0, 0), 255);
    for (int x = 32; x < 63; ++x) EXPECT_LE(centre(x, 32), centre(x + 1, 32)); // sixteen texels share a value
    for (int x = 32; x < 60; x += 4) EXPECT_LT(centre(x, 32), centre(x + 4, 32));
}

TEST(VisibilityTexture, TheCheckerboardHasTwoEqualHalves) {
    const Image<std::uint8_t> texture = visibilityTexture("checker");
    EXPECT_EQ(std::set<std::uint8_t>(texture.begin(), texture.end()).size(), 2U);
    EXPECT_EQ(std::ranges::count_if(texture, [](std::uint8_t value) { return value <= 127; }), 2048);
    EXPECT_NE(texture(0, 0), texture(8, 0));
    EXPECT_EQ(texture(0, 0), texture(8, 8));
}

TEST(LodCost, RatioAndSpreadAreMediansOverTheFrames) {
    const LodTime time = timeOf({2, 4, 2, 4}, {1, 2, 2, 1});
    EXPECT_DOUBLE_EQ(time.median, 3);
    EXPECT_DOUBLE_EQ(time.ratio, 2);  // of 2, 2, 1, 4
    EXPECT_DOUBLE_EQ(time.spread, 1); // of 1, ½, 1
}

Scene sceneWithWalk() {
    return parseScene(R"(title = "Walk"
camera = { eye = [0, 1, 10], target = [0, 1, 0], fovy = 40, near = 0.5, far = 60 }
light = { kind = "point", centre = [1, 6, 12] }
[[object]]
mesh = { sphere = { radius = 0.5 } }
lod = { triangles = [500, 80], until = [10] }
place = [{ at = [0, 1, 0] }, { at = [20, 1, 0] }, { at = [0, 1, 30] }]
[lod]
frames = 3
band = 0.2
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 2, shift = [0, 0, 4] }]
)",
                      "walk.toml", Profile::Gate);
}

TEST(LodWalk, MovesItsOwnCameraAndCullsWhatItCannotSee) {
    const Scene scene = sceneWithWalk();
    const WalkFrame start = walkFrame(scene, 0, 1), end = walkFrame(scene, 2, 1);
    ASSERT_EQ(start.instances.size(), 1U); // the others are beside and behind the camera
    EXPECT_EQ(start.instances[0].id, 1U);
    EXPECT_EQ(start.camera, start.previousCamera);
    EXPECT_EQ(start.inTransition(), 1U);
    EXPECT_EQ(end.camera.eye, glm::dvec3(0, 1, 14));
    EXPECT_EQ(end.previousCamera.eye, glm::dvec3(0, 1, 12));
    EXPECT_EQ(end.instances[0].selection, (LodSelection{1, 0}));
    EXPECT_EQ(snapshot(scene, 2).camera.eye, glm::dvec3(0, 1, 10)); // shadows know nothing of it
}

TEST(LodWalk, OverlappingTransitionsAndMissingWalksAreErrors) {
    Scene scene = sceneWithWalk();
    scene.lod.reset();
    EXPECT_THROW(walkFrame(scene, 0, 1), BadInput);
    EXPECT_THROW(parseScene(R"(title = "Overlap"
camera = { eye = [0, 1, 10], target = [0, 1, 0], fovy = 40, near = 0.5, far = 60 }
light = { kind = "point", centre = [1, 6, 12] }
[[object]]
mesh = { sphere = { radius = 0.5 } }
lod = { triangles = [500, 320, 80], until = [10, 12] }
[lod]
frames = 3
band = 0.2
)",
                            "overlap.toml", Profile::Gate),
                 BadInput);
}

TEST(LodWalk, ReversedTrianglesAreTheSameSurfaces) {
    const Scene scene = sceneWithWalk(), reversed = withTrianglesReversed(scene);
    const Mesh &mesh = *scene.objects[0].levels[0].mesh, &other = *reversed.objects[0].levels[0].mesh;
    EXPECT_EQ(mesh.positions, other.positions);
    EXPECT_EQ(mesh.triangles.front(), other.triangles.back());
}

} // namespace
} // namespace shadowbench::lod
