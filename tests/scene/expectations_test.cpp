// What scene files expect of techniques, and that the failure scenes say it.
#include "base/error.h"
#include "scene/load/load.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

TEST(SceneExpect, IsReadWithItsBoundsAndReasons) {
    const Scene scene = parseScene(
        "title = \"x\"\ncamera = { eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
        "light = { kind = \"point\", centre = [1, 5, 2] }\n[[object]]\nmesh = { box = { size = [2, 1, 2] } }\n"
        "[expect]\n"
        "fails = [{ technique = \"vsm\", metric = \"leak\", above = { gate = 0.05, paper = 0.1 }, reason = \"a\" }]\n"
        "holds = [{ technique = \"pcf:kernel=7\", metric = \"rmse\", below = 0.3, reason = \"b\" }]\n",
        "x.toml", Profile::Paper);
    ASSERT_EQ(scene.expectations.size(), 2U);
    const Expectation &holds = scene.expectations[0], &fails = scene.expectations[1];
    EXPECT_EQ(fails.technique, "vsm");
    EXPECT_EQ(fails.bound.metric, "leak");
    EXPECT_EQ(fails.bound.value, 0.1);
    EXPECT_FALSE(fails.bound.below);
    EXPECT_EQ(fails.reason, "a");
    EXPECT_EQ(holds.technique, "pcf:kernel=7");
    EXPECT_EQ(holds.bound.value, 0.3);
    EXPECT_TRUE(holds.bound.below);
}

Scene withExpectations(const std::string& lines) {
    return parseScene(
        "title = \"x\"\ncamera = { eye = [0, 2, 6], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
        "light = { kind = \"point\", centre = [1, 5, 2] }\n[[object]]\nmesh = { box = { size = [2, 1, 2] } }\n[expect]\n" +
            lines,
        "x.toml", Profile::Gate);
}

TEST(SceneExpect, TakesAListOfVariantsForOneReason) {
    const Scene scene = withExpectations(
        "fails = [{ technique = [\"vsm\", \"esm:kernel=3\"], metric = \"leak\", above = 0.1, reason = \"a\" }]\n");
    ASSERT_EQ(scene.expectations.size(), 2U);
    EXPECT_EQ(scene.expectations[0].technique, "vsm");
    EXPECT_EQ(scene.expectations[1].technique, "esm:kernel=3");
    EXPECT_EQ(scene.expectations[1].bound.value, 0.1);
    EXPECT_EQ(scene.expectations[1].reason, "a");
    EXPECT_THROW(withExpectations("holds = [{ technique = [], metric = \"leak\", below = 0.1, reason = \"a\" }]"), BadInput);
}

TEST(SceneExpect, SaysWhereTechniquesBreak) {
    const Scene scene = withExpectations(
        "breaks = [{ technique = \"sm-psm\", axis = \"near-plane\", between = [0.1, 0.5], reason = \"a\" }]\n"
        "never_breaks = [{ technique = \"sm-lispsm\", axis = \"near-plane\", reason = \"b\" }]\n");
    ASSERT_EQ(scene.breaks.size(), 2U);
    EXPECT_EQ(scene.breaks[0].technique, "sm-psm");
    EXPECT_EQ(scene.breaks[0].axis, "near-plane");
    EXPECT_EQ(scene.breaks[0].between, glm::dvec2(0.1, 0.5));
    EXPECT_EQ(scene.breaks[0].reason, "a");
    EXPECT_EQ(scene.breaks[1].technique, "sm-lispsm");
    EXPECT_FALSE(scene.breaks[1].between);
}

TEST(SceneExpect, ABreakNeedsTwoBoundsInOrderAndNoBreakHasNone) {
    for (const std::string wrong :
         {"breaks = [{ technique = \"t\", axis = \"map\", reason = \"a\" }]",
          "breaks = [{ technique = \"t\", axis = \"map\", between = [2], reason = \"a\" }]",
          "breaks = [{ technique = \"t\", axis = \"map\", between = [2, 1], reason = \"a\" }]",
          "never_breaks = [{ technique = \"t\", axis = \"map\", between = [1, 2], reason = \"a\" }]"})
        EXPECT_THROW(withExpectations(wrong), BadInput) << wrong;
}

TEST(SceneExpect, IsEmptyWhereASceneSaysNothing) { EXPECT_TRUE(loadScene("windmills", Profile::Gate).expectations.empty()); }

/// Built-in scenes that are not standard ones.
std::vector<std::string> otherScenes() {
    std::vector<std::string> ids = builtinScenes();
    ids.erase(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(standardScenes().size()));
    return ids;
}

TEST(SceneExpect, EveryOtherBuiltinSceneSaysWhatItShowsAndToleratesInEveryProfile) {
    for (const std::string& id : otherScenes())
        for (const Profile profile : {Profile::Gate, Profile::Standard, Profile::Paper}) {
            const Scene scene = loadScene(id, profile);
            EXPECT_GT(scene.shows.size(), 20U) << id;
            EXPECT_FALSE(scene.tolerance.empty()) << id;
        }
}

TEST(SceneExpect, NoSceneExpectsTwoThingsOfOneMetric) {
    for (const std::string& id : otherScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        std::set<std::pair<std::string, std::string>> said;
        for (const auto& [technique, bound, reason] : scene.expectations)
            EXPECT_TRUE(said.insert({technique, bound.metric}).second) << id << ": " << technique << " " << bound.metric;
    }
}

TEST(SceneExpect, VolumesAreToHoldOnlyOnClosedMeshes) {
    for (const std::string& id : otherScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        const bool holds = std::ranges::any_of(
            scene.expectations, [](const Expectation& e) { return e.technique == "volume-zfail" && e.bound.below; });
        if (!holds) continue;
        for (const Object& object : scene.objects)
            for (const Level& level : object.levels) EXPECT_TRUE(level.mesh->closed) << id << ": " << object.name;
    }
}

TEST(SceneExpect, TheThesissScenesHaveItsTriangles) { // Zápotocký 5.2 and 5.3
    EXPECT_EQ(snapshot(loadScene("basic", Profile::Gate), 0).triangles(), 17408U);
    // Seven closed meshes cannot have 16,301 triangles each, an odd number: 16,300, and 12 of the floor.
    EXPECT_EQ(snapshot(loadScene("huge", Profile::Gate), 0).triangles(), 7U * 16300 + 12);
    EXPECT_EQ(loadScene("basic", Profile::Paper).size, glm::ivec2(700, 700));
}

} // namespace
} // namespace shadowbench
