// Set-ups without a defined answer are refused; their near neighbours are not. Scattered fields keep their promises.
#include "base/error.h"
#include "scene/load/load.h"
#include "scene/load/scene_file.h"
#include "scene/meshes/scatter.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

namespace shadowbench {
namespace {

std::string sceneText(const std::string& eye, const std::string& light) {
    return fmt::format(
        "title = \"x\"\ncamera = {{ eye = {}, target = [0.3, 0.2, -7], fovy = 40, near = 0.01, far = 60 }}\n"
        "light = {{ {} }}\n"
        "[[object]]\nmesh = {{ sphere = {{ radius = 1, triangles = 320 }} }}\nplace = [{{ at = [5, 0, 0], scale = 2 }}]\n"
        "[[object]]\nmesh = {{ box = {{ size = [4, 1, 1] }} }}\nplace = [{{ at = [-5, 0, 0], turn = 45 }}]\n",
        eye, light);
}

const std::string kFarLight = "kind = \"point\", centre = [0, 20, 0]";
const std::string kFarEye = "[0, 3, 12]";

bool loads(const std::string& eye, const std::string& light) {
    try {
        parseScene(sceneText(eye, light), "x.toml", Profile::Gate);
        return true;
    } catch (const BadInput&) {
        return false;
    }
}

TEST(SceneSound, TheEyeMayBeInTheBoundingBoxButNotInTheMesh) {
    EXPECT_TRUE(loads("[0, 0, 0]", kFarLight));
    EXPECT_FALSE(loads("[5, 0, 0]", kFarLight));      // the sphere's centre
    EXPECT_FALSE(loads("[6.6, 0, 0]", kFarLight));    // within its radius of 2 after scaling, not before
    EXPECT_TRUE(loads("[6.8, 1.8, 1.8]", kFarLight)); // in the corner of its box
    EXPECT_FALSE(loads("[-6.2, 0, 1.2]", kFarLight)); // along the turned box
    EXPECT_TRUE(loads("[-6.2, 0, -1.2]", kFarLight)); // across it, in its bounding box
}

TEST(SceneSound, ALightMayBeNearASurfaceButNotOnIt) {
    EXPECT_FALSE(loads(kFarEye, "kind = \"point\", centre = [-5, 0.5, 0]"));
    EXPECT_TRUE(loads(kFarEye, "kind = \"point\", centre = [-5, 0.50001, 0]"));
    EXPECT_TRUE(loads(kFarEye, "kind = \"point\", centre = [-5, 0.2, 0]")) << "inside is dark, but defined";
    EXPECT_FALSE(loads(kFarEye, "kind = \"line\", centre = [-5, 0.7, 0], u = [0, 1, 0]"));
    EXPECT_TRUE(loads(kFarEye, "kind = \"line\", centre = [-5, 1.1, 0], u = [0, 1, 0]"));
    EXPECT_FALSE(loads(kFarEye, "kind = \"rectangle\", centre = [-5, 0.5, 0], u = [0.1, 0, 0], v = [0, 0, 0.1]"))
        << "in its plane";
    EXPECT_TRUE(loads(kFarEye, "kind = \"rectangle\", centre = [-5, 0.6, 0], u = [9, 0, 0], v = [0, 0, 9]"));
    EXPECT_FALSE(loads(kFarEye, "kind = \"disk\", centre = [0, 0, 0], u = [12, 0, 0], v = [0, 0, 12]")) << "cuts both";
    EXPECT_TRUE(loads(kFarEye, "kind = \"disk\", centre = [0, 0, 0], u = [3, 0, 0], v = [0, 0, 3]")) << "between them";
}

TEST(SceneSound, AScenePutTogetherInCodeIsCheckedToo) {
    Scene scene = parseScene(sceneText(kFarEye, kFarLight), "x.toml", Profile::Gate);
    EXPECT_NO_THROW(requireWellPosed(scene));
    scene.light = {LightKind::Rectangle, {0, 20, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, 0}};
    try {
        requireWellPosed(scene);
        FAIL() << "accepted";
    } catch (const BadInput& error) {
        EXPECT_EQ(std::string(error.what()).find("x: light.v: the light has no size"), 0U) << error.what();
    }
}

/// What is wrong with the scene after `change`, which no scene file could make.
std::string problemOf(const std::function<void(Scene&)>& change) {
    Scene scene = parseScene(sceneText(kFarEye, kFarLight), "x.toml", Profile::Gate);
    change(scene);
    const std::optional<Problem> problem = findProblem(scene);
    return problem ? problem->key + ": " + problem->sentence : "";
}

TEST(SceneSound, ADirectionOfNoLengthGivesNoLight) {
    EXPECT_EQ(problemOf([](Scene& scene) {
                  scene.light = {LightKind::Directional, {}, {0, 0, 0}};
              }),
              "light.direction: expected a vector other than zero");
    EXPECT_EQ(problemOf([](Scene& scene) { scene.light = {LightKind::Directional, {}, {0, -1, 0}}; }), "");
}

TEST(SceneSound, FramesOfTheApproachAndOfTheWalkAreCheckedToo) {
    EXPECT_EQ(problemOf([](Scene& scene) {
                  scene.timeline.approach = 2;
                  scene.eye.keys = {{-2, scene.camera.target}, {0, scene.camera.eye}};
              }),
              "camera.target: the camera looks at its own eye");
    const auto walk = [](double meet) {
        return [meet](Scene& scene) {
            scene.lod = LodWalk{.frames = 4, .eye = {}, .target = {}};
            scene.lod->target.keys = {{0, scene.camera.target}, {meet, scene.camera.eye}};
        };
    };
    EXPECT_EQ(problemOf(walk(3)), "lod.path: the camera looks at its own eye at frame 3 of the walk");
    EXPECT_EQ(problemOf(walk(4)), "") << "after the last frame";
}

TEST(SceneSound, WhatSweepsMoveFartherThanAnyFileMayIsRefused) {
    const std::string where = "farther than 1e+12 m from the origin at frame 59; ";
    EXPECT_EQ(problemOf([](Scene& scene) { scene.camera.eye.x = 2e12; }), "camera.eye: lies " + where + "move it nearer");
    for (const int part : {0, 1, 2}) {
        const auto move = [&](Scene& scene) {
            scene.light = {LightKind::Rectangle, {0, 20, 0}, {}, {1, 0, 0}, {0, 0, 1}};
            if (part == 0) scene.light.centre.y = 2e12;
            if (part == 1) scene.light.u.x = 2e12;
            if (part == 2) scene.light.v.z = 2e12;
        };
        EXPECT_EQ(problemOf(move), "light.centre: the light reaches " + where + "move it nearer") << part;
    }
    const std::string object = "object: an object reaches " + where + "make it smaller or move it nearer";
    EXPECT_EQ(problemOf([](Scene& scene) { scene.objects[0].instances[0].place[3].x = 2e12; }), object);
    EXPECT_EQ(problemOf([](Scene& scene) { scene.objects[0].instances[0].place[3].x = -2e12; }), object);
    EXPECT_EQ(problemOf([](Scene& scene) { scene.objects.clear(); }), "") << "nothing is no problem of its own";
}

/// Shapes whose bounding boxes overlap and that still lie apart: each is told from its neighbour that touches.
TEST(SceneSound, ALightBesideASlantedTriangleDoesNotTouchIt) {
    const auto touches = [](const Light& light) {
        Mesh slanted;
        slanted.positions = {{0, 0, 0}, {2, 2, 0}, {2, 2, 2}};
        slanted.triangles = {{0, 1, 2}};
        return problemOf([&](Scene& scene) {
                   scene.objects.resize(1);
                   scene.objects[0].levels[0].mesh = std::make_shared<const Mesh>(slanted);
                   scene.objects[0].instances = {{glm::dmat4(1), 0}};
                   scene.light = light;
               })
            .starts_with("light.centre: the light lies on a surface");
    };
    EXPECT_TRUE(touches({LightKind::Point, {1.5, 1.5, 0.5}}));
    EXPECT_FALSE(touches({LightKind::Point, {1.5, 1.4, 0.5}})) << "below its plane";
    EXPECT_FALSE(touches({LightKind::Point, {0.5, 0.5, 1.5}})) << "in its plane, beyond an edge";
    EXPECT_TRUE(touches({LightKind::Line, {1.5, 1.5, 0.5}, {}, {1, -1, 0}}));
    EXPECT_FALSE(touches({LightKind::Line, {0.8, 0.8, 1.6}, {}, {1, -1, 0}})) << "through the plane, beyond an edge";
    EXPECT_FALSE(touches({LightKind::Line, {0.6, 0.6, 1.4}, {}, {1, 1, 1}})) << "in the plane, along an edge";
    EXPECT_TRUE(touches({LightKind::Rectangle, {1.5, 1.5, 0.5}, {}, {1, -1, 0}, {0, 0, 1}}));
    EXPECT_FALSE(touches({LightKind::Rectangle, {0.5, 0.5, 1.5}, {}, {0.6, -0.6, 0}, {0, 0, 0.6}}));
    EXPECT_FALSE(touches({LightKind::Rectangle, {2.1, 0.9, 1}, {}, {0, 2, 0}, {0, 0, 1}})) << "in a plane beside it";
    EXPECT_FALSE(touches({LightKind::Rectangle, {1, 1, 1.7}, {}, {1, 1, 0}, {1, -1, 0}})) << "above it, cutting its plane";
}

TEST(SceneScatter, FillsTheFieldWithExactlyTheCountAndKeepsClearOfTheEye) {
    for (const int count : {1, 7, 24, 400, 4000}) {
        Scatter field;
        field.count = count;
        field.half = {8, 5};
        field.centre = {1, 0.5, -2};
        field.keepOff = {1, 3};
        field.clear = 2;
        const std::vector<glm::dmat4> places = scattered(field);
        ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
        for (const glm::dmat4& place : places) {
            const glm::dvec3 at(place[3]);
            EXPECT_LE(std::abs(at.x - 1), 8);
            EXPECT_LE(std::abs(at.z + 2), 5);
            EXPECT_EQ(at.y, 0.5);
            EXPECT_GE(glm::distance(glm::dvec2(at.x, at.z), field.keepOff), 2);
        }
        EXPECT_EQ(scattered(field), places);
    }
}

TEST(SceneScatter, KeepsInstancesApartByTheShareOfACellThatJitterLeaves) {
    Scatter field;
    field.count = 100;
    field.half = {10, 10}; // cells of 2 m
    field.jitter = 0.5;
    const std::vector<glm::dmat4> places = scattered(field);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_GE(glm::distance(places[i][3], places[j][3]), 1 - 1e-12);
    field.seed = 2;
    EXPECT_NE(scattered(field), places);
}

} // namespace
} // namespace shadowbench
