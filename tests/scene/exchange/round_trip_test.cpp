// Every built-in scene, exported: loaded again it is the same scene, and its files say, to who reads them by their
// description, what the truth is computed from.
#include "groundtruth/contract/reference_key.h"
#include "scene/masked_mesh.h"
#include "scene/meshes/import.h"
#include "scene/sky.h"
#include "tests/scene/exchange/exported_folder.h"
#include "tests/scene/exchange/same_scene.h"
#include "tests/support/test_names.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {

using Json = nlohmann::json;

class EveryScene : public testing::TestWithParam<std::string> {
protected:
    const Scene scene = loadScene(GetParam(), Profile::Gate);
    const ExportedFolder folder{scene};
};

/// What the reference of a snapshot would be kept under: two equal keys have one truth.
std::string truthOf(const Snapshot& frame, const Scene& scene) {
    return groundtruth::key({frame, scene.size, groundtruth::usualTruth(frame.light), scene.referenceSamples}, {});
}

std::map<std::uint32_t, std::pair<const Batch*, const Placement*>> byId(const Snapshot& frame) {
    std::map<std::uint32_t, std::pair<const Batch*, const Placement*>> instances;
    for (const Batch& batch : frame.batches)
        for (const Placement& placement : batch.placements) instances[placement.id] = {&batch, &placement};
    return instances;
}

void expectCamera(const Json& json, const Camera& camera, const glm::ivec2& size) {
    EXPECT_EQ(vectorOf(json["eye"]), camera.eye);
    EXPECT_EQ(vectorOf(json["target"]), camera.target);
    EXPECT_EQ(vectorOf(json["up"]), camera.up);
    EXPECT_EQ(json["fovy"], camera.fovy);
    EXPECT_EQ(json["near"], camera.near);
    EXPECT_EQ(json["far"], camera.far);
    EXPECT_EQ(json["aspect"], static_cast<double>(size.x) / size.y);
}

void expectLight(const Json& json, const Light& light) {
    EXPECT_EQ(json["kind"], std::string(name(light.kind)));
    const bool distant = light.kind == LightKind::Directional || light.isEnvironment();
    EXPECT_EQ(vectorOf(json[distant ? "direction" : "centre"]), distant ? light.direction : light.centre);
    if (light.isArea()) {
        EXPECT_EQ(vectorOf(json["u"]), light.u);
    }
    if (light.kind == LightKind::Rectangle || light.kind == LightKind::Disk) {
        EXPECT_EQ(vectorOf(json["v"]), light.v);
    }
    if (light.isEnvironment()) {
        EXPECT_EQ(json["suns"].size(), light.environment->suns.size());
        EXPECT_EQ(json["sky"].size(), 1U);
    }
}

/// Cards that a mask cuts holes into are written as such, too, and what our reader leaves of them is the mesh.
TEST_P(EveryScene, ItsCardsAndMasksReadAgainAreTheSameTriangles) {
    std::set<std::string> masked;
    for (const Object& object : scene.objects)
        if (object.levels[0].mesh->cards) masked.insert(object.name);
    EXPECT_EQ(!masked.empty(), folder.json("scene.json").contains("cards"));
    EXPECT_EQ(!masked.empty(), std::filesystem::exists(folder.path() / "cards.gltf"));
    if (masked.empty()) return;
    const std::map<std::string, Mesh> parts = importParts(folder.path() / "cards.gltf");
    for (const Object& object : scene.objects) {
        const Mesh &mesh = *object.levels[0].mesh, &read = parts.at(object.name);
        EXPECT_EQ(read.positions, mesh.positions) << object.name;
        EXPECT_EQ(read.triangles, mesh.triangles) << object.name;
    }
    const Json gltf = folder.json("cards.gltf");
    for (const Json& material : gltf.at("materials")) {
        EXPECT_EQ(material.value("alphaMode", "OPAQUE") == "MASK", masked.contains(material.at("name"))) << material;
        if (!masked.contains(material.at("name"))) continue;
        const Json& base = material.at("pbrMetallicRoughness").at("baseColorTexture");
        const Json& texture = gltf.at("textures").at(base.at("index").get<std::size_t>());
        const Json& sampler = gltf.at("samplers").at(texture.at("sampler").get<std::size_t>());
        EXPECT_EQ(sampler.at("magFilter"), sampler.at("minFilter")) << "no mipmaps, of which the truth has none";
    }
}

TEST_P(EveryScene, LoadedAgainIsTheSameScene) {
    const Scene again = loadScene(folder.path().string(), Profile::Gate);
    expectSameScene(scene, again);
    for (const int frame : scoredFrames(scene))
        EXPECT_EQ(truthOf(snapshot(scene, frame), scene), truthOf(snapshot(again, frame), again)) << frame;
}

TEST_P(EveryScene, IsInItsJsonAndObjFrameByFrame) {
    const Json json = folder.json("scene.json");
    const std::map<std::string, Mesh> groups = groupsOf(folder.text("scene.obj"));
    const std::vector<int> frames = scoredFrames(scene);
    EXPECT_EQ(json["scene"], scene.id);
    EXPECT_EQ(json["size"], Json::array({scene.size.x, scene.size.y}));
    ASSERT_EQ(json["frames"].size(), frames.size());
    ASSERT_EQ(json["meshes"].size(), groups.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        SCOPED_TRACE(frames[i]);
        const Snapshot truth = snapshot(scene, frames[i]);
        const Json& frame = json["frames"][i];
        EXPECT_EQ(frame["index"], frames[i]);
        EXPECT_EQ(frame["role"], i == 0 ? "scored" : "moving");
        expectCamera(frame["camera"], truth.camera, scene.size);
        expectLight(frame["light"], truth.light);
        const auto instances = byId(truth);
        ASSERT_EQ(frame["nodes"].size(), instances.size());
        for (const Json& node : frame["nodes"]) {
            const auto [batch, placement] = instances.at(node["id"]);
            EXPECT_EQ(matrixOf(node["matrix"]), placement->world);
            EXPECT_EQ(groups.at(node["mesh"]).positions, batch->mesh->positions);
            EXPECT_EQ(groups.at(node["mesh"]).triangles, batch->mesh->triangles);
        }
    }
}

TEST_P(EveryScene, IsInItsGltfAtTheScoredFrame) {
    const Json gltf = folder.json("scene.gltf"), json = folder.json("scene.json");
    const std::string bin = folder.text("scene.bin");
    const Snapshot truth = snapshot(scene, scoredFrames(scene).front());
    const auto instances = byId(truth);
    ASSERT_EQ(gltf["nodes"].size(), instances.size() + 2); // the camera and the light
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Json& node = gltf["nodes"][i];
        const auto [batch, placement] = instances.at(node["extras"]["shadowbench"]["id"]);
        EXPECT_EQ(node["name"], json["frames"][0]["nodes"][i]["name"]);
        EXPECT_EQ(gltf["meshes"][node["mesh"].get<std::size_t>()]["name"], json["frames"][0]["nodes"][i]["mesh"]);
        EXPECT_EQ(node.contains("matrix") ? matrixOf(node["matrix"]) : glm::dmat4(1), placement->world);
        expectSameMesh(meshOf(gltf, node, bin), *batch->mesh);
    }
    expectCamera(gltf["cameras"][0]["extras"]["shadowbench"], truth.camera, scene.size);
    expectLight(gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"]["shadowbench"], truth.light);
}

/// The places of camera and light, which who reads no extras goes by.
TEST_P(EveryScene, HasItsCameraAndLightAsGltfDefinesThem) {
    const Json gltf = folder.json("scene.gltf");
    const Snapshot truth = snapshot(scene, scoredFrames(scene).front());
    const std::size_t last = gltf["nodes"].size() - 1;
    ASSERT_EQ(gltf["nodes"][last - 1]["camera"], 0);
    const glm::dmat4 view = glm::inverse(matrixOf(gltf["nodes"][last - 1]["matrix"]));
    const Json& lens = gltf["cameras"][0]["perspective"];
    const glm::dmat4 projection = glm::perspective(lens["yfov"].get<double>(), lens["aspectRatio"].get<double>(),
                                                   lens["znear"].get<double>(), lens["zfar"].get<double>());
    const glm::dmat4 expected =
        truth.camera.projection(static_cast<double>(scene.size.x) / scene.size.y) * truth.camera.view();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR((projection * view)[column][row], expected[column][row],
                        1e-9 * (1 + std::abs(expected[column][row])));

    const Light hard = truth.light.centreOnly();
    const Json& light = gltf["extensions"]["KHR_lights_punctual"]["lights"][0];
    const glm::dmat4 world = matrixOf(gltf["nodes"][last]["matrix"]);
    EXPECT_EQ(light["type"], std::string(name(hard.kind)));
    if (hard.kind == LightKind::Point)
        EXPECT_EQ(glm::dvec3(world[3]), hard.centre);
    else
        EXPECT_LT(glm::length(glm::dvec3(-world[2]) - hard.direction), 1e-12); // it shines along −z
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryScene, testing::ValuesIn(builtinScenes()), nameOfText);

} // namespace
} // namespace shadowbench
