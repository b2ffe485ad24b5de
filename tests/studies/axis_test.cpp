// What the axes of sweeps move in scenes, and the parameters of techniques that they are.
#include "base/error.h"
#include "scene/load/load.h"
#include "studies/sweep/axis.h"
#include "techniques/catalog.h"
#include "tests/support/message_of.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

Scene moved(const std::string& id, const std::string& axis, double value) {
    Scene scene = loadScene(id, Profile::Gate);
    axisNamed(axis).move(scene, value);
    return scene;
}

TEST(CameraSpeed, IsThatAtWhichTheCameraComesToWhereItIsAtRest) {
    const Scene scene = loadScene("moving-camera", Profile::Gate);
    const glm::dvec3 rest = scene.camera.eye, end = scene.eye.keys.back().value;
    const double frames = scene.eye.keys.back().frame;
    for (const double speed : {0.5, 1.0, 2.5, 4.0}) {
        const Scene moving = moved("moving-camera", "camera-speed", speed);
        ASSERT_EQ(moving.timeline.still, 1) << "the frame of arrival is scored";
        const Snapshot last = snapshot(moving, 0);
        EXPECT_EQ(last.camera.eye, rest);
        EXPECT_NEAR(glm::distance(last.camera.eye, last.previousCamera.eye), speed * glm::distance(rest, end) / frames,
                    1e-9);
        EXPECT_LT(glm::distance(snapshot(moving, -moving.timeline.approach).camera.eye, end), 1e-9);
    }
}

TEST(CameraSpeed, OfACameraThatApproachesIsThatOfItsApproach) {
    const Scene scene = loadScene("turned-camera", Profile::Gate), twice = moved("turned-camera", "camera-speed", 2);
    for (const int frame : {0, -5, -10, -15})
        EXPECT_LT(glm::distance(snapshot(twice, frame).camera.target, snapshot(scene, 2 * frame).camera.target), 1e-9);
    EXPECT_EQ(snapshot(twice, -20).camera.target, snapshot(scene, -30).camera.target) << "stands before";
}

TEST(CameraSpeed, EndsWhereTheWayIsOneFrame) {
    EXPECT_EQ(axisNamed("camera-speed").valuesFor(loadScene("moving-camera", Profile::Gate)),
              (std::vector<double>{0.125, 0.25, 0.5, 1, 2, 4}));
}

TEST(CameraSpeed, IsOfScenesWhoseCameraMoves) {
    const std::string refused = test::messageOf<BadInput>([] { moved("alpha-foliage", "camera-speed", 1); });
    EXPECT_NE(refused.find("stands still; choose a scene with a [camera] path, such as moving-camera"), std::string::npos)
        << refused;
    EXPECT_THROW(moved("moving-camera", "camera-speed", 0), BadInput);
}

TEST(WorldOffset, MovesAllThatHasAPlaceAlike) {
    for (const char* id : {"moving-camera", "large-world", "windmills"}) {
        const Scene scene = loadScene(id, Profile::Gate), far = moved(id, "world-offset", 1e5);
        const glm::dvec3 by(8e4, 0, -6e4);
        EXPECT_EQ(far.moved - scene.moved, by);
        const int last = scene.timeline.frames() - 1;
        for (const int frame : {0, last}) {
            const Snapshot near = snapshot(scene, frame), moved = snapshot(far, frame);
            EXPECT_LT(glm::distance(moved.camera.eye, near.camera.eye + by), 1e-9);
            EXPECT_LT(glm::distance(moved.camera.target, near.camera.target + by), 1e-9);
            EXPECT_EQ(moved.light.direction, near.light.direction);
            if (near.light.kind != LightKind::Directional) {
                EXPECT_LT(glm::distance(moved.light.centre, near.light.centre + by), 1e-9);
            }
            ASSERT_EQ(moved.batches.size(), near.batches.size());
            for (std::size_t i = 0; i < near.batches.size(); ++i)
                for (std::size_t j = 0; j < near.batches[i].placements.size(); ++j)
                    EXPECT_LT(glm::distance(glm::dvec3(moved.batches[i].placements[j].world[3]),
                                            glm::dvec3(near.batches[i].placements[j].world[3]) + by),
                              1e-9);
        }
    }
}

double solidArea(const Scene& scene) {
    const Mesh& mesh = *std::ranges::find(scene.objects, "crowns", &Object::name)->levels[0].mesh;
    double sum = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        sum += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return sum;
}

TEST(AlphaCutoff, LeavesLessOfTheLeavesTheHigherItIs) {
    double before = 1e30;
    for (const double cutoff : axisNamed("alpha-cutoff").values) {
        const double area = solidArea(moved("alpha-foliage", "alpha-cutoff", cutoff));
        EXPECT_LT(area, 0.95 * before) << cutoff;
        EXPECT_GT(area, 0) << cutoff;
        before = area;
    }
    EXPECT_EQ(solidArea(moved("alpha-foliage", "alpha-cutoff", 0.5)), solidArea(loadScene("alpha-foliage", Profile::Gate)));
}

TEST(AlphaCutoff, IsOfMeshesThatAnAlphaTestCutsOut) {
    const std::string refused = test::messageOf<BadInput>([] { moved("simple", "alpha-cutoff", 0.5); });
    EXPECT_NE(refused.find("choose a scene with leaf_cards, such as alpha-foliage"), std::string::npos) << refused;
    for (const double cutoff : {0.0, 1.0}) EXPECT_THROW(moved("alpha-foliage", "alpha-cutoff", cutoff), BadInput);
}

std::string at(const std::string& axis, const std::string& variant, double value) {
    return axisNamed(axis).at(techniques::parseVariant(variant), value).name;
}

TEST(AxesOfTechniques, AreTheParametersThatStateTheSame) {
    EXPECT_EQ(at("map", "sm-uniform", 512), "sm-uniform:map=512");
    EXPECT_EQ(at("cascades", "sm-cascaded:warp=lispsm", 2), "sm-cascaded:slices=2,warp=lispsm");
    EXPECT_EQ(at("cascades", "sdsm", 1), "sdsm:slices=1");
    EXPECT_EQ(at("cascades", "accumulated", 4), "accumulated:cascades=4");
    EXPECT_EQ(at("rays", "ray-traced", 4), "ray-traced:rays=4");
    EXPECT_EQ(at("rays", "ray-denoised", 2), "ray-denoised:rays=2");
    EXPECT_EQ(at("page-budget", "sm-adaptive", 64), "sm-adaptive:pages=64");
    EXPECT_EQ(at("page-budget", "sm-clipmap", 64), "sm-clipmap:map=1024");
    EXPECT_EQ(at("page-budget", "sm-clipmap:page=64", 9), "sm-clipmap:page=64,map=192");
    EXPECT_EQ(at("accumulation-length", "accumulated", 20), "accumulated:share=0.05");
    EXPECT_EQ(at("accumulation-length", "ray-denoised", 5), "ray-denoised");
}

TEST(AxesOfTechniques, LeaveParametersThatStateSomethingElse) {
    for (const auto& [axis, variant] : std::vector<std::pair<std::string, std::string>>{
             {"cascades", "occlusion-texture"},      // slices of depth, parallel to the light
             {"rays", "prt-haar"},                   // of the precomputation
             {"accumulation-length", "sm-adaptive"}, // share of a page's pixels
             {"page-budget", "sm-cascaded"}})
        EXPECT_EQ(axisNamed(axis).parameterOf(techniques::parseVariant(variant)), nullptr) << variant;
}

TEST(AxesOfTechniques, TakeWhatTheParameterTakes) {
    const std::string refused = test::messageOf<BadInput>([] { at("page-budget", "sm-clipmap", 50); });
    EXPECT_NE(refused.find("such as 49 or 64, not 50"), std::string::npos) << refused;
    EXPECT_THROW(at("cascades", "sm-cascaded", 9), BadInput);
    EXPECT_THROW(at("accumulation-length", "accumulated", 0.5), BadInput);
}

} // namespace
} // namespace shadowbench
