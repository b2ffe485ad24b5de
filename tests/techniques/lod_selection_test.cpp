// Which level an instance shows, how much of it is seen, in which frame, and where two frames are combined.
#include "base/error.h"
#include "base/random.h"
#include "harness/measure/lod_cost.h"
#include "harness/render/walk.h"
#include "scene/load/load.h"
#include "scene/meshes/primitives.h"
#include "techniques/lod/lod-frame-sequential/alternation.h"
#include "techniques/lod/lod-frame-sequential/combined_tiles.h"
#include "techniques/lod/lod-frame-sequential/visibility_texture.h"
#include "techniques/lod/transition.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>

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

TEST(LodAlternation, ShowsTheLevelsInTurnOddAndEvenInstancesTheOtherWayRound) {
    Alternation alternation;
    const auto instances = instancesAt({{0, 0}, {0, 0.2}, {1, 0.7}});
    for (int frame = 0; frame < 4; ++frame) {
        const auto draws = alternation.next(instances);
        ASSERT_EQ(draws.size(), 3U);
        EXPECT_EQ(draws[0].level, 0);
        EXPECT_EQ(draws[0].id, 0U); // not in transition
        EXPECT_EQ(draws[0].visibility, 1);
        EXPECT_EQ(draws[1].level, frame % 2 == 0 ? 1 : 0);
        EXPECT_FLOAT_EQ(draws[1].visibility, frame % 2 == 0 ? 0.4F : 1.0F);
        EXPECT_EQ(draws[2].level, frame % 2 == 0 ? 1 : 2);
        EXPECT_FLOAT_EQ(draws[2].visibility, frame % 2 == 0 ? 0.6F : 1.0F); // the second half: the coarser one is whole
        EXPECT_EQ(draws[1].id, 1U);
        EXPECT_EQ(draws[2].id, 2U);
    }
}

TEST(LodAlternation, AnEvenNumberOfLikeInstancesDrawsAsMuchInEveryFrame) { // dissertation 5.2
    Alternation alternation;
    const std::vector<LodInstance> instances = [] {
        std::vector<LodInstance> result;
        for (std::uint32_t id = 7; id < 7 + 40; ++id) result.push_back({id, 0, {}, {}, {0, 0.3}});
        return result;
    }();
    for (int frame = 0; frame < 6; ++frame)
        EXPECT_EQ(std::ranges::count(alternation.next(instances), 1, &LevelDraw::level), 20) << frame;
}

TEST(LodAlternation, AnInstanceThatComesIntoViewOrIntoATransitionStartsWithTheWholeLevel) {
    Alternation alternation;
    const auto inTransition = instancesAt({{0, 0.2}, {0, 0.2}});
    const auto levels = [&](const std::vector<LodInstance>& instances) {
        const auto draws = alternation.next(instances);
        return std::pair{draws[0].level, draws[1].level};
    };
    EXPECT_EQ(levels(inTransition), (std::pair{0, 1})); // the first frame fills both buffers
    EXPECT_EQ(levels(inTransition), (std::pair{1, 0}));
    EXPECT_TRUE(alternation.next({}).empty()); // culled
    EXPECT_EQ(levels(inTransition), (std::pair{0, 0}));
    EXPECT_EQ(levels(inTransition), (std::pair{0, 1})); // whose turn it is not shows the whole level once more
    EXPECT_EQ(levels(inTransition), (std::pair{1, 0}));
    EXPECT_EQ(levels(instancesAt({{1, 0.2}, {1, 0.8}})),
              (std::pair{1, 2})); // the next transition: whole is finer, then coarser
    alternation.reset();
    EXPECT_EQ(levels(inTransition), (std::pair{0, 1}));
}

TEST(LodAlternation, IdsAreDistinctOverTwoFramesForAsManyAsThereAre) {
    Alternation alternation;
    Random random(3);
    std::map<std::uint32_t, std::uint32_t> before; // by instance
    for (int frame = 0; frame < 20; ++frame) {
        std::vector<LodInstance> instances;
        for (std::uint32_t id = 1; id <= 1000; ++id)
            if (random.uniform() < 0.1) instances.push_back({60000 + id, 0, {}, {}, {0, 0.5}});
        std::map<std::uint32_t, std::uint32_t> now;
        std::set<std::uint32_t> inBefore, inNow;
        for (const auto& [instance, id] : before) inBefore.insert(id);
        for (const LevelDraw& draw : alternation.next(instances)) {
            ASSERT_TRUE(1 <= draw.id && draw.id <= 255);
            if (const auto shown = before.find(draw.instance->id); shown != before.end())
                EXPECT_EQ(draw.id, shown->second);
            else
                EXPECT_FALSE(inBefore.contains(draw.id));
            EXPECT_TRUE(now.emplace(draw.instance->id, draw.id).second);
            inNow.insert(draw.id);
        }
        EXPECT_EQ(inNow.size(), now.size());
        before = std::move(now);
    }
}

TEST(LodAlternation, MoreThanThereAreIdsShareThem) {
    Alternation alternation;
    std::vector<LodInstance> instances;
    for (std::uint32_t id = 1; id <= 300; ++id) instances.push_back({id, 0, {}, {}, {0, 0.5}});
    std::set<std::uint32_t> ids;
    for (const LevelDraw& draw : alternation.next(instances)) ids.insert(draw.id);
    EXPECT_EQ(ids.size(), 255U);
    EXPECT_EQ(*ids.begin(), 1U);
    EXPECT_EQ(*ids.rbegin(), 255U);
}

/// Share of the screen that rectangles cover, each counted for itself.
double area(const std::vector<glm::vec4>& rectangles) {
    double sum = 0;
    for (const glm::vec4& r : rectangles) sum += 0.25 * (r.z - r.x) * (r.w - r.y);
    return sum;
}

TEST(CombinedTiles, AreAllThatARectangleTouchesEachOnce) {
    CombinedTiles tiles({16, 10}); // 4 × 3 tiles, the top ones half as high
    EXPECT_TRUE(tiles.rectangles().empty());
    tiles.mark({{-0.9, -0.9}, {-0.4, -0.9}}); // two tiles at the bottom
    ASSERT_EQ(tiles.rectangles().size(), 1U);
    EXPECT_EQ(tiles.rectangles()[0], glm::vec4(-1, -1, 0, 2.0F * 4 / 10 - 1));
    tiles.mark({{-0.9, -0.9}, {-0.4, -0.9}});
    tiles.mark({{0.6, 0.9}, {5, 7}}); // the last one at the top
    EXPECT_EQ(tiles.rectangles().size(), 2U);
    EXPECT_FLOAT_EQ(static_cast<float>(area(tiles.rectangles())), (2.0F * 4 * 4 + 4 * 2) / (16 * 10));
    tiles.mark({{1.1, -1}, {2, 1}}); // beside the screen
    EXPECT_EQ(tiles.rectangles().size(), 2U);
    tiles.mark({{-0.9, -0.9}, {-0.4, 0.9}}); // all above the first two
    EXPECT_EQ(tiles.rectangles().size(), 2U);
    tiles.mark({{-1, -1}, {1, 1}});
    ASSERT_EQ(tiles.rectangles().size(), 1U);
    EXPECT_EQ(tiles.rectangles()[0], glm::vec4(-1, -1, 1, 1));
}

TEST(CombinedTiles, HoldAllThatAnotherCameraSeesBehindABox) {
    Random random(11);
    const auto within = [&](double reach) {
        return glm::dvec3(random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach));
    };
    int inside = 0, whole = 0;
    for (int i = 0; i < 500; ++i) {
        const Camera one{within(3), within(3) - glm::dvec3(0, 0, 20), {0, 1, 0}, 40, 0.5, 100};
        Camera other = one;
        other.eye += within(1);
        other.target += within(1);
        const glm::dmat4 projection = one.projection(1.5), view = one.view(),
                         otherClip = other.projection(1.5) * other.view();
        const glm::dvec3 at = within(4) - glm::dvec3(0, 0, 10), half = glm::abs(within(1)) + 0.1;
        const SeenBox box = seenBox({at - half, at + half}, projection * view, {300, 200});
        const ScreenRectangle seen = rectangleBehind(box, projection, otherClip * glm::inverse(projection * view));
        whole += seen.low == glm::dvec2(-1) && seen.high == glm::dvec2(1) ? 1 : 0;
        for (int sample = 0; sample < 50; ++sample) {
            const glm::dvec3 inBox = at + half * within(1);
            const glm::dvec3 behind = one.eye + (inBox - one.eye) / random.uniform(0.01, 1);
            const glm::dvec4 clip = otherClip * glm::dvec4(behind, 1);
            if (clip.w <= 0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            ++inside;
            EXPECT_TRUE(clip.x >= seen.low.x * clip.w && clip.x <= seen.high.x * clip.w && clip.y >= seen.low.y * clip.w &&
                        clip.y <= seen.high.y * clip.w)
                << i;
        }
    }
    EXPECT_GT(inside, 10000);
    EXPECT_LT(whole, 50);
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
