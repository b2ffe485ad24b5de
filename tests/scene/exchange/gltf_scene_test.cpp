// A .gltf as a scene: our own exports give the truth that they were exported with, others what glTF says.
#include "base/error.h"
#include "groundtruth/contract/reference_key.h"
#include "tests/scene/exchange/exported_folder.h"
#include "tests/scene/exchange/same_scene.h"
#include "tests/support/test_names.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class GltfOfAScene : public testing::TestWithParam<std::string> {
protected:
    const Scene scene = loadScene(GetParam(), Profile::Gate);
    const ExportedFolder folder{scene};
};

TEST_P(GltfOfAScene, IsTheWholeSceneWithTheFileBesideIt) {
    expectSameScene(scene, loadScene((folder.path() / "scene.gltf").string(), Profile::Gate));
}

TEST_P(GltfOfAScene, AloneHasTheScoredFramesTruth) {
    fs::remove(folder.path() / (scene.id + ".toml"));
    const Scene alone = loadScene((folder.path() / "scene.gltf").string(), Profile::Gate);
    EXPECT_EQ(alone.id, scene.id);
    EXPECT_EQ(alone.size, scene.size);
    const Snapshot before = snapshot(scene, scoredFrames(scene).front()),
                   after = snapshot(alone, scoredFrames(alone).front());
    EXPECT_EQ(after.camera, before.camera);
    EXPECT_EQ(after.light.kind, before.light.kind);
    EXPECT_EQ(after.light.centre, before.light.centre);
    EXPECT_LT(glm::distance(after.light.direction, before.light.direction), 1e-15) << "normalised again";
    EXPECT_EQ(after.light.u, before.light.u);
    EXPECT_EQ(after.light.v, before.light.v);
    const auto placements = [](const Snapshot& frame) {
        std::map<std::uint32_t, std::pair<const Mesh*, glm::dmat4>> all;
        for (const Batch& batch : frame.batches)
            for (const Placement& placement : batch.placements) all[placement.id] = {batch.mesh.get(), placement.world};
        return all;
    };
    const auto expected = placements(before), found = placements(after);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [id, instance] : expected) {
        ASSERT_TRUE(found.contains(id)) << id;
        EXPECT_EQ(found.at(id).second, instance.second) << id;
        expectSameMesh(*found.at(id).first, *instance.first);
    }
}

/// The standard ones, and some that show failures; what the files hold of all is tested in round_trip_test.cpp.
INSTANTIATE_TEST_SUITE_P(BuiltIn, GltfOfAScene,
                         testing::Values("dueling-frusta", "overlapping-occluders", "simple", "windmills", "trees",
                                         "stacked-plates", "caster-behind-eye"),
                         nameOfText);

/// A triangle under a point light in a file of another program's making: camera and light under turned parents.
class ForeignGltf : public testing::Test {
protected:
    [[nodiscard]] Scene loaded() const {
        writeFile(folder_.path() / "other.gltf", gltf.dump());
        return loadScene((folder_.path() / "other.gltf").string(), Profile::Gate);
    }
    [[nodiscard]] std::string refusal() const {
        try {
            static_cast<void>(loaded());
            return "loaded";
        } catch (const BadInput& error) {
            return error.what();
        }
    }
    void expectRefused(const std::string& reason) const {
        const std::string said = refusal();
        EXPECT_NE(said.find("other.gltf"), std::string::npos) << said;
        EXPECT_NE(said.find(reason), std::string::npos) << said;
    }

    ForeignGltf() {
        const float positions[] = {-1, 0, -1, 0, 0, 1, 1, 0, -1};
        const std::uint32_t indices[] = {0, 1, 2};
        std::string bytes(sizeof positions + sizeof indices, '\0');
        std::memcpy(bytes.data(), positions, sizeof positions);
        std::memcpy(bytes.data() + sizeof positions, indices, sizeof indices);
        writeFile(folder_.path() / "other.bin", bytes);
    }

    TemporaryFolder folder_;
    Json gltf = Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
        "nodes": [{"mesh": 0, "translation": [0, 0.5, 0], "scale": [2, 2, 2]},
                  {"rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476], "translation": [0, 5, 0], "children": [2]},
                  {"camera": 0},
                  {"translation": [1, 4, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7853981633974483, "znear": 0.1, "zfar": 20,
                                                            "aspectRatio": 1.5}}],
        "meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
        "buffers": [{"uri": "other.bin", "byteLength": 48}]})");
};

TEST_F(ForeignGltf, HasCameraLightAndMeshesWhereItsNodesPutThem) {
    const Scene scene = loaded();
    EXPECT_EQ(scene.id, "other");
    EXPECT_EQ(scene.size, glm::ivec2(384, 256));
    EXPECT_EQ(scene.timeline.moving, 0);
    EXPECT_LT(glm::distance(scene.camera.eye, glm::dvec3(0, 5, 0)), 1e-12);
    EXPECT_LT(glm::distance(scene.camera.basis().forward, glm::dvec3(0, -1, 0)), 1e-12) << "turned from -z downwards";
    EXPECT_NEAR(scene.camera.fovy, 45, 1e-12);
    EXPECT_EQ(scene.light.kind, LightKind::Point);
    EXPECT_EQ(scene.light.centre, glm::dvec3(1, 4, 0));
    ASSERT_EQ(scene.objects.size(), 1U);
    EXPECT_FALSE(scene.objects[0].levels[0].mesh->closed);
    const glm::dmat4 place = scene.objects[0].instances[0].place;
    EXPECT_EQ(glm::dvec3(place * glm::dvec4(1, 0, -1, 1)), glm::dvec3(2, 0.5, -2));
}

TEST_F(ForeignGltf, ADirectionalLightShinesAlongItsNodesMinusZ) {
    gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "directional";
    gltf["nodes"][3]["rotation"] = {-0.7071067811865476, 0, 0, 0.7071067811865476};
    EXPECT_LT(glm::distance(loaded().light.direction, glm::dvec3(0, -1, 0)), 1e-12);
}

TEST_F(ForeignGltf, WhatIsNoSceneIsNamed) {
    const Json whole = gltf;
    const std::pair<std::function<void(Json&)>, std::string> faults[] = {
        {[](Json& g) { g["asset"]["version"] = "1.0"; }, "no glTF 2.0"},
        {[](Json& g) {
             g["scenes"][0]["nodes"] = {0, 3};
         },
         "hold 0 of kind camera"},
        {[](Json& g) {
             g["scenes"][0]["nodes"] = {0, 1};
         },
         "hold 0 of kind light"},
        {[](Json& g) {
             g["scenes"][0]["nodes"] = {1, 3};
         },
         "no node of it shows a mesh"},
        {[](Json& g) { g["nodes"][2]["children"] = {1}; }, "are no tree"},
        {[](Json& g) { g["nodes"][0]["mesh"] = 7; }, "no meshes[7]"},
        {[](Json& g) {
             g["nodes"][0]["scale"] = {1, 2, 1};
         },
         "stretches or shears"},
        {[](Json& g) { g["meshes"][0].erase("name"); }, "meshes[0] has no name"},
        {[](Json& g) { g["cameras"][0]["perspective"].erase("zfar"); }, "has no zfar"},
        {[](Json& g) { g["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "spot"; }, "of type spot"},
        {[](Json& g) { g["nodes"][0]["translation"] = "here"; }, "of another kind"},
    };
    for (const auto& [spoil, reason] : faults) {
        gltf = whole;
        spoil(gltf);
        expectRefused(reason);
    }
}

} // namespace
} // namespace shadowbench
