// Camera, light, tracks and snapshots against closed forms.
#include "base/random.h"
#include "scene/load/load.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

const Camera kCamera{{3.1, 4.2, 7.3}, {0.2, 0.6, -0.4}, {0, 1, 0}, 37, 0.3, 55};
const glm::ivec2 kSize{320, 200};

TEST(SceneCamera, ProjectUndoesRay) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 pixel(random.uniform(0, kSize.x), random.uniform(0, kSize.y));
        const double depth = random.uniform(0.5, 50);
        const glm::dvec3 back = kCamera.project(kCamera.eye + depth * kCamera.ray(pixel, kSize), kSize);
        EXPECT_NEAR(back.x, pixel.x, 1e-10); // double rounding over a path of about ten operations on numbers up to 320
        EXPECT_NEAR(back.y, pixel.y, 1e-10);
        EXPECT_NEAR(back.z, depth, 1e-12 * 50);
    }
}

TEST(SceneCamera, AgreesWithProjectionTimesView) {
    Random random(4);
    const glm::dmat4 clipFromWorld = kCamera.projection(static_cast<double>(kSize.x) / kSize.y) * kCamera.view();
    for (int i = 0; i < 200; ++i) {
        const glm::dvec2 pixel(random.uniform(0, kSize.x), random.uniform(0, kSize.y));
        const glm::dvec4 clip =
            clipFromWorld * glm::dvec4(kCamera.eye + random.uniform(0.5, 50) * kCamera.ray(pixel, kSize), 1.0);
        EXPECT_NEAR(clip.x / clip.w, 2 * pixel.x / kSize.x - 1, 1e-12);
        EXPECT_NEAR(clip.y / clip.w, 1 - 2 * pixel.y / kSize.y, 1e-12);
    }
}

TEST(SceneCamera, TheMiddleOfTheImageLooksForward) {
    EXPECT_LT(glm::distance(kCamera.ray({160, 100}, kSize), glm::normalize(kCamera.target - kCamera.eye)), 1e-15);
    const Camera down{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90, 0.1, 10};
    const glm::dvec3 corner = down.ray({0, 0}, {100, 100}); // top left at 90°: one to the left and one up
    EXPECT_NEAR(corner.x, -1, 1e-12);
    EXPECT_NEAR(corner.y, 1, 1e-12);
    EXPECT_LT(kCamera.project(kCamera.eye - kCamera.basis().forward, kSize).z, 0);
}

TEST(SceneLight, ARectangleIsSampledUniformlyInArea) {
    const Light light{LightKind::Rectangle, {1, 5, 2}, {0, -1, 0}, {2, 0, 0}, {0, 0, 4}};
    EXPECT_EQ(light.sample({0.5, 0.5}), light.centre);
    EXPECT_EQ(light.sample({0, 0}), glm::dvec3(0, 5, 0));
    EXPECT_EQ(light.sample({0.75, 0.25}), glm::dvec3(1.5, 5, 1)); // an affine map: uniform in area
}

TEST(SceneLight, ADiskIsSampledUniformlyInArea) {
    const Light light{LightKind::Disk, {1, 5, 2}, {0, -1, 0}, {2, 0, 0}, {0, 0, 2}};
    constexpr int kGrid = 100;
    int within = 0, right = 0;
    for (int i = 0; i < kGrid; ++i) {
        for (int j = 0; j < kGrid; ++j) {
            const glm::dvec3 p = light.sample({(i + 0.5) / kGrid, (j + 0.5) / kGrid}) - light.centre;
            ASSERT_EQ(p.y, 0);
            ASSERT_LE(glm::length(p), 1);
            within += glm::length(p) < 0.5 ? 1 : 0;
            right += p.x > 0 ? 1 : 0;
        }
    }
    EXPECT_NEAR(within, 0.25 * kGrid * kGrid, kGrid); // half the radius holds a quarter of the area; one column of the grid
    EXPECT_NEAR(right, 0.5 * kGrid * kGrid, kGrid);
}

TEST(SceneLight, ALineIsSampledAlongItsLength) {
    const Light light{LightKind::Line, {1, 5, 2}, {0, -1, 0}, {2, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(light.sample({0.25, 0.9}), glm::dvec3(0.5, 5, 2));
    EXPECT_EQ(light.centreOnly().kind, LightKind::Point);
    EXPECT_EQ(light.centreOnly().centre, light.centre);
}

TEST(SceneLight, ADirectionalLightIsAPointAtInfinity) {
    const Light light{LightKind::Directional, {1, 5, 2}, {0, -1, 0}, {}, {}};
    EXPECT_EQ(light.homogeneous(), glm::dvec4(0, 1, 0, 0));
    EXPECT_EQ(light.centreOnly(), light);
}

TEST(SceneTrack, IsLinearBetweenKeysAndConstantOutside) {
    const Track track{{{2, {0, 0, 0}}, {4, {2, 0, 4}}, {5, {2, 2, 4}}}};
    EXPECT_EQ(track.at(0, {9, 9, 9}), glm::dvec3(0, 0, 0));
    EXPECT_EQ(track.at(3, {9, 9, 9}), glm::dvec3(1, 0, 2));
    EXPECT_EQ(track.at(4.5, {9, 9, 9}), glm::dvec3(2, 1, 4));
    EXPECT_EQ(track.at(8, {9, 9, 9}), glm::dvec3(2, 2, 4));
    EXPECT_EQ(Track{}.at(3, {9, 9, 9}), glm::dvec3(9, 9, 9));
}

const char* const kMoving = R"(# Two balls that turn while the eye comes near.
title  = "Moving"
camera = { eye = [0, 2, 30], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60, path = [
    { frame = 0, eye = [0, 2, 30] }, { frame = 4, eye = [0, 2, 6] } ] }
light  = { kind = "directional", direction = [0, -2, 0] }
[timeline]
still = 5
moving = 4
[[object]]
mesh = { sphere = { radius = 1 } }
lod = { triangles = [320, 80], until = [12] }
place = [{ at = [-2, 1.5, 0] }, { at = [2, 1.5, 0], turn = 90, scale = 2 }]
spin = { axis = [0, 0, 2], degrees_per_frame = 10, phase = "random" }
[[object]]
mesh = { sphere = { radius = 0.3, triangles = 80 } }
path = [{ frame = 0, shift = [0, 0, 0] }, { frame = 2, shift = [1, 0, 0] }]
)";

Scene moving() { return parseScene(kMoving, "moving.toml", Profile::Gate); }

std::set<std::uint32_t> idsOf(const Snapshot& frame) {
    std::set<std::uint32_t> ids;
    for (const Batch& batch : frame.batches)
        for (const Placement& placement : batch.placements) ids.insert(placement.id);
    return ids;
}

TEST(SceneSnapshot, TheApproachLeadsToTheStillFrames) {
    std::string text = kMoving;
    text.replace(text.find("still = 5"), 9, "approach = 4\nstill = 5");
    text.replace(text.find("{ frame = 0, eye = [0, 2, 30] }"), 31,
                 "{ frame = -4, eye = [0, 2, 46] }, { frame = 0, eye = [0, 2, 30] }");
    const Scene scene = parseScene(text, "moving.toml", Profile::Gate);
    EXPECT_EQ(snapshot(scene, -4).camera.eye, glm::dvec3(0, 2, 46));
    EXPECT_EQ(snapshot(scene, -4).previousCamera.eye, glm::dvec3(0, 2, 46)); // there is none before
    EXPECT_EQ(snapshot(scene, -1).camera.eye, glm::dvec3(0, 2, 34));
    EXPECT_EQ(snapshot(scene, 0).camera.eye, glm::dvec3(0, 2, 30));
    EXPECT_EQ(snapshot(scene, 0).previousCamera.eye, glm::dvec3(0, 2, 34));
    EXPECT_EQ(snapshot(scene, 1).previousCamera.eye, glm::dvec3(0, 2, 30));
    EXPECT_EQ(snapshot(scene, 4).camera.eye, glm::dvec3(0, 2, 30)); // the last still frame
    EXPECT_EQ(snapshot(scene, 8).camera.eye, glm::dvec3(0, 2, 6));
}

const Placement& placementOf(const Snapshot& frame, std::uint32_t id) {
    for (const Batch& batch : frame.batches)
        for (const Placement& placement : batch.placements)
            if (placement.id == id) return placement;
    throw std::logic_error("no such placement");
}

TEST(SceneSnapshot, IsAtRestOverTheStillFrames) {
    const Scene scene = moving();
    const Snapshot first = snapshot(scene, 0), last = snapshot(scene, 4);
    EXPECT_EQ(first.camera, last.camera);
    EXPECT_EQ(last.camera, last.previousCamera);
    EXPECT_EQ(first.light.direction, glm::dvec3(0, -1, 0));
    for (const std::uint32_t id : idsOf(first)) {
        EXPECT_EQ(placementOf(first, id).world, placementOf(last, id).world);
        EXPECT_EQ(placementOf(last, id).world, placementOf(last, id).previous);
    }
    for (const Batch& batch : last.batches) EXPECT_FALSE(batch.moving);
}

TEST(SceneSnapshot, KeepsIdsOverFramesAndLevels) {
    const Scene scene = moving();
    const Snapshot far = snapshot(scene, 0), near = snapshot(scene, 8);
    EXPECT_EQ(idsOf(far), (std::set<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(idsOf(near), idsOf(far));
    EXPECT_EQ(far.triangles(), 80U * 3);         // both balls coarse at 30 m
    EXPECT_EQ(near.triangles(), 320U * 2 + 80U); // and fine at 6 m
    EXPECT_EQ(far.batches.size(), 2U);
    // The coarse level's mesh is the very one that the other object asks for only if radius and count are the same.
    EXPECT_NE(far.batches[0].mesh, far.batches[1].mesh);
}

TEST(SceneSnapshot, AMeshThatDeformsIsInThePoseOfItsFrame) {
    std::string text = kMoving;
    text +=
        "[[object]]\nmesh = { walker = { triangles = 400, poses = 3 } }\nplace = [{ at = [1, 0, 0] }, { at = [2, 0, 0] }]\n"
        "pose = [0, 2]\n";
    const Scene scene = parseScene(text, "moving.toml", Profile::Gate);
    const Object& walkers = scene.objects.back();
    ASSERT_EQ(walkers.poses.size(), 3U);
    EXPECT_EQ(walkers.poses[0], walkers.levels[0].mesh);
    EXPECT_FALSE(walkers.still());
    const auto batchOf = [](const Snapshot& frame, std::uint32_t id) {
        for (const Batch& batch : frame.batches)
            if (std::ranges::count(batch.placements, id, &Placement::id) > 0) return batch;
        throw std::logic_error("no such placement");
    };
    for (int frame = 0; frame < scene.timeline.frames(); ++frame) {
        const Snapshot now = snapshot(scene, frame);
        const int moved = std::max(0, frame - 4);
        for (const auto& [id, start] : {std::pair(4U, 0), std::pair(5U, 2)}) {
            const Batch batch = batchOf(now, id);
            EXPECT_EQ(batch.mesh, walkers.poses[static_cast<std::size_t>((start + moved) % 3)]) << frame;
            EXPECT_EQ(batch.moving, moved > 0);
            EXPECT_EQ(batch.previousMesh,
                      moved == 0 ? nullptr : walkers.poses[static_cast<std::size_t>((start + moved + 2) % 3)]);
            EXPECT_EQ(placementOf(now, id).world, placementOf(now, id).previous) << "the transform stands still";
        }
        EXPECT_EQ(batchOf(now, 1).previousMesh, nullptr);
    }
}

TEST(SceneSnapshot, PreviousIsTheFrameBefore) {
    const Scene scene = moving();
    for (int frame = 5; frame < scene.timeline.frames(); ++frame) {
        const Snapshot before = snapshot(scene, frame - 1), now = snapshot(scene, frame);
        EXPECT_EQ(now.previousCamera, before.camera);
        for (const std::uint32_t id : idsOf(now)) EXPECT_EQ(placementOf(now, id).previous, placementOf(before, id).world);
    }
    EXPECT_TRUE(snapshot(scene, 5).batches.front().moving);
    EXPECT_NEAR(placementOf(snapshot(scene, 5), 3).world[3].x, 0.5, 1e-12);
}

TEST(SceneSnapshot, BoundsHoldEveryPlacement) {
    const Bounds box = snapshot(moving(), 0).bounds();
    // Balls of radius 1 at −2 and 2 at 2, whose flat triangles fall short by at most 3 %; a turned box is at most √2 larger.
    EXPECT_LE(box.low.x, -2.97);
    EXPECT_GE(box.low.x, -2 - std::sqrt(2.0));
    EXPECT_GE(box.high.x, 2 + 2 * 0.97);
    EXPECT_LE(box.high.x, 2 + 2 * std::sqrt(2.0));
}

TEST(SceneSnapshot, InstancesOfTheSameMeshShareIt) {
    const Scene scene =
        parseScene("title = \"x\"\ncamera = { eye = [0, 2, 30], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
                   "light = { kind = \"point\", centre = [0, 9, 0] }\n"
                   "[[object]]\nmesh = { tree = { triangles = 300, seed = 3 } }\n"
                   "[[object]]\nmesh = { tree = { triangles = 300, seed = 3 } }\nplace = [{ at = [5, 0, 0] }]\n"
                   "[[object]]\nmesh = { tree = { triangles = 300, seed = 4 } }\nplace = [{ at = [9, 0, 0] }]\n",
                   "x.toml", Profile::Gate);
    EXPECT_EQ(scene.objects[0].levels[0].mesh, scene.objects[1].levels[0].mesh);
    EXPECT_NE(scene.objects[0].levels[0].mesh, scene.objects[2].levels[0].mesh);
}

} // namespace
} // namespace shadowbench
