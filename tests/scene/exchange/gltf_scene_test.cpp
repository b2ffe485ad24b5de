// A .gltf as a scene: our own exports give the truth that they were exported with, others what glTF says.
#include "groundtruth/contract/reference_key.h"
#include "tests/scene/exchange/exported_folder.h"
#include "tests/scene/exchange/foreign_gltf.h"
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

/// Others' meshes are welded, and ours are not: equal vertices come back as two.
TEST(GltfOfAMesh, KeepsVerticesThatAreEqual) {
    Scene scene = loadScene("stacked-plates", Profile::Gate);
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Mesh two{corners, {{0, 1, 2}, {3, 4, 5}}};
    scene.objects[0].levels = {{std::make_shared<const Mesh>(two)}};
    const ExportedFolder folder{scene};
    const Scene back = loadScene((folder.path() / "scene.gltf").string(), Profile::Gate);
    expectSameMesh(*back.objects[0].levels[0].mesh, two);
}

/// The standard ones, and some that show failures; what the files hold of all is tested in round_trip_test.cpp.
INSTANTIATE_TEST_SUITE_P(BuiltIn, GltfOfAScene,
                         testing::Values("dueling-frusta", "overlapping-occluders", "simple", "windmills", "trees",
                                         "stacked-plates", "caster-behind-eye"),
                         nameOfText);

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
        {[](Json& g) { g["asset"]["version"] = 1; }, "no glTF 2.0"},
        {[](Json& g) {
             g["scenes"][0]["nodes"] = {1, 3};
         },
         "no node of it shows a triangle"},
        {[](Json& g) { g["nodes"][2]["children"] = {1}; }, "are no tree"},
        {[](Json& g) { g["nodes"][0]["mesh"] = 7; }, "no meshes[7]"},
        {[](Json& g) { g["cameras"][0]["perspective"].erase("zfar"); }, "has no zfar, and no min and max"},
        {[](Json& g) { g["nodes"][0]["translation"] = "here"; }, "\"translation\" is no list"},
        {[](Json& g) { g["meshes"][0]["primitives"][0] = 3; }, "of another kind"},
        {[](Json& g) {
             g["meshes"][0]["primitives"] = {{"a", 1}};
         },
         "\"primitives\" is no list"},
        {[](Json& g) { g["nodes"][0]["extensions"] = 1; }, "\"extensions\" is no object"},
        {[](Json& g) { g["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, "requires the extension KHR_draco"},
        {[](Json& g) { g["accessors"][0]["sparse"] = Json::object(); }, "mesh \"tri\": accessors[0] is sparse"},
        {[](Json& g) { g["accessors"][0]["type"] = "VEC2"; }, "accessors[0] is of type \"VEC2\", not VEC3"},
        {[](Json& g) { g["accessors"][0]["count"] = 4; }, "accessors[0] reaches beyond its bufferView"},
        {[](Json& g) { g["accessors"][1]["count"] = 2; }, "its 2 corners are no list of triangles"},
        {[](Json& g) { g["accessors"][0]["count"] = 2; }, "a triangle uses position 2 of 2"},
        {[](Json& g) { g["bufferViews"][0]["byteOffset"] = 20; }, "reaches beyond its buffer"},
        {[](Json& g) { g["meshes"][0]["primitives"][0]["mode"] = 7; }, "no mode 7"},
        {[](Json& g) { g["buffers"][0]["uri"] = "data:application/octet-stream;base64,=AAA"; }, "is no base64"},
        {[](Json& g) { g["buffers"][0].erase("uri"); }, "buffers[0] names no file"},
    };
    for (const auto& [spoil, reason] : faults) {
        gltf = whole;
        spoil(gltf);
        expectRefused(reason);
    }
}

} // namespace
} // namespace shadowbench
