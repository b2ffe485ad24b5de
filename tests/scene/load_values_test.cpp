// What a scene file's values become, and the limits that hold whatever it asks for.
#include "base/error.h"
#include "scene/load/load.h"
#include "tests/support/message_of.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace shadowbench {
namespace {

/// A sound scene; its object's body begins on line 5.
std::string sceneOf(const std::string& body) {
    return "title = \"x\"\ncamera = { eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
           "light = { kind = \"point\", centre = [1, 5, 2] }\n[[object]]\n" +
           body + "\n";
}

const std::string kBox = "mesh = { box = { size = [2, 1, 2] } }";

std::string messageOf(const std::string& toml) {
    return test::messageOf<BadInput>([&] { parseScene(toml, "scenes/x.toml", Profile::Gate); });
}

/// A variable of the environment, while the object lives.
class Set {
public:
    Set(std::string name, const std::string& value) : name_(std::move(name)) { ::setenv(name_.c_str(), value.c_str(), 1); }
    ~Set() { ::unsetenv(name_.c_str()); }

private:
    std::string name_;
};

TEST(SceneFile, LimitsOfInstancesAndMemoryHold) {
    const std::string places = sceneOf("mesh = { plane = { half = 2 } }\nplace = [{}, { at = [9, 0, 0] }, {}]");
    EXPECT_EQ(messageOf(places), "");
    {
        const Set two("SHADOWBENCH_MAX_INSTANCES", "2");
        EXPECT_EQ(messageOf(places), "scenes/x.toml:6: object[1].place: has 3 instances, more than the 2 of "
                                     "SHADOWBENCH_MAX_INSTANCES, which can be raised");
    }
    const Set mib("SHADOWBENCH_MAX_MEMORY_MIB", "1");
    EXPECT_EQ(messageOf("size = 1024\n" + sceneOf(kBox)).find("scenes/x.toml:5: object: the scene needs "), 0U)
        << messageOf("size = 1024\n" + sceneOf(kBox));
    const std::string fine = sceneOf("mesh = { sphere = { radius = 1, triangles = 200000 } }");
    EXPECT_EQ(messageOf(fine).find("scenes/x.toml:5: object[1].mesh.sphere: with it the scene's meshes take "), 0U)
        << messageOf(fine);
}

TEST(SceneFile, ASpinTakesOnePhaseForAllOrARandomOneForEach) {
    const auto phases = [](const std::string& phase) {
        const std::string text = sceneOf("mesh = { box = { size = [2, 1, 2] } }\nplace = [{}, { at = [9, 0, 0] }]\nspin = { "
                                         "axis = [0, 1, 0], degrees_per_frame = 3, phase = " +
                                         phase + " }");
        const Scene scene = parseScene(text, "scenes/x.toml", Profile::Gate);
        return std::pair(scene.objects[0].instances[0].phase, scene.objects[0].instances[1].phase);
    };
    EXPECT_EQ(phases("30"), std::pair(30.0, 30.0));
    EXPECT_NE(phases("\"random\"").first, phases("\"random\"").second);
    EXPECT_EQ(phases("\"random\""), phases("\"random\""));
}

TEST(SceneFile, WhatASceneShowsIsItsFirstCommentWithoutTheLinesEnd) {
    EXPECT_EQ(parseScene("#  A plate. \r\n" + sceneOf(kBox), "x.toml", Profile::Gate).shows, "A plate.");
    EXPECT_EQ(parseScene("#\n" + sceneOf(kBox), "x.toml", Profile::Gate).shows, "");
}

TEST(SceneFile, EachProfileHasItsUsualSize) {
    const auto side = [](Profile profile) { return parseScene(sceneOf(kBox), "scenes/x.toml", profile).size.x; };
    EXPECT_EQ(side(Profile::Gate), 256);
    EXPECT_EQ(side(Profile::Standard), 512);
    EXPECT_EQ(side(Profile::Paper), 1024);
}

} // namespace
} // namespace shadowbench
