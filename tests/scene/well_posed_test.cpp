// Set-ups without a defined answer are refused; their near neighbours are not. Scattered fields keep their promises.
#include "base/error.h"
#include "scene/load/load.h"
#include "scene/meshes/scatter.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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
