// Scenes as modelling programs write them: .glb, several primitives, trees of nodes that stretch and mirror; and what a
// scene file may say of them.
#include "base/base64.h"
#include "scene/mesh_faults.h"
#include "tests/scene/exchange/foreign_gltf.h"
#include "tests/scene/exchange/same_scene.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace shadowbench {
namespace {

class GltfOfOthers : public ForeignGltf {
protected:
    [[nodiscard]] std::string refusalThrough(const std::string& lines) const {
        return refusalOf([&] { return through(lines); });
    }

    /// A second camera and a second light.
    void addViews() {
        gltf["cameras"][0]["name"] = "Left";
        gltf["cameras"].push_back(gltf["cameras"][0]);
        gltf["cameras"][1]["name"] = "Right";
        gltf["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "directional"}, {"name", "Sun"}});
        gltf["nodes"].push_back({{"camera", 1}, {"translation", {0, 2, 7}}});
        gltf["nodes"].push_back({{"name", "Lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
        gltf["scenes"][0]["nodes"] = {0, 1, 3, 4, 5};
    }

    /// Puts `values` at the end of the buffer, as an accessor of its own.
    template <class T>
    std::size_t addAccessor(const std::vector<T>& values, int component, const std::string& type, std::size_t count) {
        gltf["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", values.size() * sizeof(T)}});
        bin.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        bin.resize((bin.size() + 3) / 4 * 4, '\0');
        writeFile(folder_.path() / "other.bin", bin);
        gltf["accessors"].push_back({{"bufferView", gltf["bufferViews"].size() - 1},
                                     {"componentType", component},
                                     {"count", count},
                                     {"type", type}});
        return gltf["accessors"].size() - 1;
    }
};

glm::dvec3 corner(const Object& object, std::size_t triangle, int number) {
    const Mesh& mesh = *object.levels[0].mesh;
    const glm::dvec3 position(mesh.positions[mesh.triangles.at(triangle)[number]]);
    return glm::dvec3(object.instances.at(0).place * glm::dvec4(position, 1));
}

TEST_F(GltfOfOthers, IsTheSameSceneFromAllContainers) {
    const Scene beside = loaded();
    gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bin);
    expectSameScene(beside, loaded());
    gltf["buffers"][0].erase("uri");
    Scene binary = loaded("another.glb", glbOf(gltf.dump(), bin));
    EXPECT_EQ(binary.id, "another");
    EXPECT_EQ(binary.title, "another");
    binary.id = beside.id;
    binary.title = beside.title;
    expectSameScene(beside, binary);
    gltf["buffers"][0]["uri"] = "other.bin";
    EXPECT_EQ(loaded("beside.glb", glbOf(gltf.dump(), "")).objects.size(), 1U);
}

TEST_F(GltfOfOthers, ADamagedContainerIsNamed) {
    gltf["buffers"][0].erase("uri");
    const std::string whole = glbOf(gltf.dump(), bin);
    const auto expect = [&](std::string content, const std::string& reason) {
        const std::string said = refusalOf([&] { return loaded("other.glb", content); });
        expectWithin(said, "other.glb");
        expectWithin(said, reason);
    };
    const auto changed = [&](std::size_t at, char byte) {
        std::string content = whole;
        content.at(at) = byte;
        return content;
    };
    expect("", "does not begin as a .glb does");
    expect(gltf.dump(), "does not begin as a .glb does");
    expect(changed(4, 1), "is binary glTF of version 1");
    expect(whole.substr(0, whole.size() - 4), fmt::format("it says that it has {} bytes, and has", whole.size()));
    expect(changed(15, 1), "one of its chunks reaches beyond its end"); // length of the JSON
    expect(changed(16, 'X'), "its first chunk is no JSON");
    for (std::size_t length = 0; length < 24; ++length) expect(whole.substr(0, length), "other.glb");
    expect(glbOf(gltf.dump(), ""), "reaches beyond its buffer");
    expect(glbOf(std::string(100, '['), ""), "nested deeper");
}

TEST_F(GltfOfOthers, EachPrimitiveIsAnObjectOfItsOwnColour) {
    gltf["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}}}, Json::object()};
    Json& primitives = gltf["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[1]["material"] = 1;
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}}); // lines
    gltf["meshes"].push_back(gltf["meshes"][0]);
    gltf["meshes"].push_back({{"primitives", {primitives[0]}}});
    gltf["nodes"].push_back({{"mesh", 1}, {"name", "Shed"}});
    gltf["nodes"].push_back({{"mesh", 2}, {"name", "Roof"}});
    gltf["nodes"].push_back({{"mesh", 0}});
    gltf["nodes"].push_back({{"mesh", 0}, {"translation", {0, 3, 0}}});
    gltf["scenes"][0]["nodes"] = {0, 1, 3, 4, 5, 6, 7};
    const Scene scene = loaded();
    std::vector<std::string> names;
    for (const Object& object : scene.objects) names.push_back(object.name);
    EXPECT_EQ(names, (std::vector<std::string>{"tri", "tri_2", "Shed", "Shed_2", "Roof", "tri", "tri_2"}));
    EXPECT_EQ(scene.objects[0].colour, glm::vec3(0.5, 0.25, 1));
    EXPECT_EQ(scene.objects[1].colour, glm::vec3(0.8F));
    EXPECT_EQ(scene.objects[0].instances.size(), 1U);
    EXPECT_EQ(scene.objects[5].instances.size(), 2U);
    EXPECT_EQ(scene.objects[6].instances.size(), 2U);
    EXPECT_EQ(scene.objects[5].levels[0].mesh, scene.objects[0].levels[0].mesh);
}

TEST_F(GltfOfOthers, NodesThatStretchAndMirrorKeepOutsideOut) {
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint16_t> indices{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    Json& drawn = gltf["meshes"][0]["primitives"][0];
    drawn["attributes"]["POSITION"] = addAccessor(positions, 5126, "VEC3", 4);
    drawn["indices"] = addAccessor(indices, 5123, "SCALAR", 12);
    gltf["nodes"][0] = {{"rotation", {0, 0.6, 0, 0.8}}, {"translation", {0, 1, 0}}, {"children", {4}}};
    gltf["nodes"].push_back(
        {{"mesh", 0}, {"scale", {1, 2, -3}}, {"rotation", {0.6, 0, 0, 0.8}}, {"translation", {4, 0, 0}}});
    const glm::dmat4 turnY = glm::rotate(glm::dmat4(1), 2 * std::acos(0.8), glm::dvec3(0, 1, 0));
    const glm::dmat4 turnX = glm::rotate(glm::dmat4(1), 2 * std::acos(0.8), glm::dvec3(1, 0, 0));
    const glm::dmat4 world = glm::translate(glm::dmat4(1), glm::dvec3(0, 1, 0)) * turnY *
                             glm::translate(glm::dmat4(1), glm::dvec3(4, 0, 0)) * turnX *
                             glm::scale(glm::dmat4(1), glm::dvec3(1, 2, -3));
    const Scene scene = loaded();
    const Mesh& mesh = *scene.objects.at(0).levels[0].mesh;
    EXPECT_TRUE(edgeFaultsOf(mesh).closed());
    EXPECT_NEAR(signedVolume(mesh), 1, 1e-6) << "a sixth, stretched by 2 and by 3, and not turned inside out";
    Bounds expected, found;
    for (std::size_t i = 0; i < 4; ++i)
        expected.add(glm::dvec3(world * glm::dvec4(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2], 1)));
    for (std::size_t i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) found.add(corner(scene.objects[0], i, c));
    EXPECT_LT(glm::distance(found.low, expected.low), 1e-6);
    EXPECT_LT(glm::distance(found.high, expected.high), 1e-6);
}

TEST_F(GltfOfOthers, WithoutAWordOnItItsFirstSceneIsShown) {
    gltf.erase("scene");
    gltf["scenes"].push_back({{"nodes", {3}}});
    EXPECT_EQ(loaded().objects.size(), 1U);
    gltf["scene"] = "first";
    expectRefused("\"first\" is no number of one of its scenes");
    gltf["scene"] = 2;
    expectRefused("it has no scenes[2]");
    gltf["scene"] = -1;
    expectRefused("-1 is no whole number");
}

TEST_F(GltfOfOthers, ANodeOfNoSizeIsHidden) {
    gltf["nodes"].push_back({{"mesh", 0}, {"scale", {0, 0, 0}}});
    gltf["scenes"][0]["nodes"] = {0, 1, 3, 4};
    EXPECT_EQ(loaded().objects.size(), 1U);
}

TEST_F(GltfOfOthers, StripsAndFansAreTrianglesThatFaceAsTheFirstDoes) {
    // A pentagon around its first corner, counter-clockwise; and a strip of a square's corners, with one repeated.
    const std::vector<float> pentagon{0, 0, 0, 2, 0, 0, 3, 1, 0, 1, 2, 0, -1, 1, 0};
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 0};
    gltf["nodes"][0].erase("scale");
    gltf["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", addAccessor(pentagon, 5126, "VEC3", 5)}}}, {"mode", 6}},
                                       {{"attributes", {{"POSITION", addAccessor(square, 5126, "VEC3", 5)}}}, {"mode", 5}}};
    const Scene scene = loaded();
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].levels[0].mesh->triangles.size(), 3U);
    EXPECT_EQ(scene.objects[1].levels[0].mesh->triangles.size(), 2U) << "what collapses is left out";
    for (const auto& [number, area] : {std::pair{0U, 5.0}, std::pair{1U, 1.0}}) {
        double sum = 0; // with the sign of the side that is seen
        const Mesh& mesh = *scene.objects[number].levels[0].mesh;
        for (const glm::uvec3& t : mesh.triangles)
            sum += 0.5 * glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z;
        EXPECT_NEAR(sum, area, 1e-6);
        EXPECT_EQ(edgeFaultsOf(mesh).turned.count, 0U);
    }
}

TEST_F(GltfOfOthers, CornersOfSharpEdgesAreJoined) {
    // Two triangles of a fold, each with corners of its own.
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1};
    Json& drawn = gltf["meshes"][0]["primitives"][0];
    drawn = {{"attributes", {{"POSITION", addAccessor(positions, 5126, "VEC3", 6)}}}};
    const Scene scene = loaded();
    const Mesh& mesh = *scene.objects.at(0).levels[0].mesh;
    EXPECT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(edgeFaultsOf(mesh).open.count, 4U);
}

TEST_F(GltfOfOthers, OfSeveralViewsASceneFileChoosesOne) {
    addViews();
    expectRefused(
        "it has 2 cameras (\"Left\", \"Right\"); choose one in a scene file with the lines gltf = \"other.gltf\" and "
        "camera = \"Left\"");
    expectWithin(refusalThrough("gltf = \"other.gltf\"\ncamera = \"Right\""), "it has 2 lights (\"light\", \"Sun\")");
    const Scene scene = through("# A level\ngltf = \"other.gltf\"\ncamera = \"Right\"\nlight = \"Sun\"");
    EXPECT_EQ(scene.id, "level");
    EXPECT_EQ(scene.title, "other");
    EXPECT_EQ(scene.shows, "A level");
    EXPECT_EQ(scene.camera.eye, glm::dvec3(0, 2, 7));
    EXPECT_EQ(scene.light.kind, LightKind::Directional);
    const std::string said = refusalThrough("title = \"x\"\ngltf = \"other.gltf\"\ncamera = \"Rigt\"\nlight = \"Sun\"");
    expectWithin(said, "level.toml:2: gltf: ");
    expectWithin(said, "it has no camera \"Rigt\" (did you mean \"Right\"?); it has \"Left\", \"Right\"");
}

TEST_F(GltfOfOthers, ACameraLooksAsFarAsTheMiddleOfTheScene) {
    for (const char* end : {"min", "max"}) gltf["accessors"][0][end] = end[1] == 'i' ? Json{-1, 0, -1} : Json{1, 0, 1};
    const auto target = [&](double height) { // of a mesh of 2 m; the camera looks down from 5 m
        gltf["nodes"][0]["translation"] = {3, height, 0};
        return loaded().camera.target;
    };
    EXPECT_LT(glm::distance(target(-25), glm::dvec3(0, -25, 0)), 1e-9);
    EXPECT_LT(glm::distance(target(300), glm::dvec3(0, 4, 0)), 1e-9) << "nothing lies ahead";
}

TEST_F(GltfOfOthers, WhatIsMissingIsNamedAsTheLinesThatGiveIt) {
    gltf["scenes"][0]["nodes"] = {0};
    for (const char* end : {"min", "max"}) gltf["accessors"][0][end] = end[1] == 'i' ? Json{-1, 0, -1} : Json{1, 0, 1};
    const std::string said = refusal();
    expectWithin(said,
                 "it has no camera and no light (of KHR_lights_punctual); export it with cameras and punctual lights, or "
                 "give them in a scene file with the lines gltf = \"other.gltf\" and camera = {");
    std::string lines = said.substr(said.find("gltf = "));
    for (std::size_t at; (at = lines.find(" and ")) != std::string::npos;) lines.replace(at, 5, "\n");
    const Scene scene = through(lines);
    const glm::dvec3 centre(0, 0.5, 0), seen = scene.camera.target;
    EXPECT_LT(glm::distance(seen, centre), 1e-3);
    EXPECT_GT(glm::distance(scene.camera.eye, centre), 2 * std::sqrt(2.0)) << "outside";
    gltf["scenes"][0]["nodes"] = {0, 3};
    expectRefused("it has no camera; export");
    gltf["scenes"][0]["nodes"] = {0, 1};
    expectRefused("it has no light (of KHR_lights_punctual); export");
}

TEST_F(GltfOfOthers, ASceneFileHasTheLastWordAndObjectsOfItsOwn) {
    const Scene scene = through(R"(
        title = "Mine"
        gltf = "other.gltf"
        size = 64
        camera = { eye = [0, 3, 9], target = [0, 0, 0], fovy = 40, near = 0.5, far = 40 }
        light = { kind = "disk", centre = [1, 6, 2], u = [1, 0, 0], v = [0, 0, 1] }
        timeline = { still = 5, moving = 3 }
        [[object]]
        name = "ground"
        mesh = { plane = { half = 9 } }
    )");
    EXPECT_EQ(scene.title, "Mine");
    EXPECT_EQ(scene.size, glm::ivec2(64));
    EXPECT_EQ(scene.camera.eye, glm::dvec3(0, 3, 9));
    EXPECT_EQ(scene.light.kind, LightKind::Disk);
    EXPECT_EQ(scene.timeline.moving, 3);
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].name, "tri");
    EXPECT_EQ(scene.objects[1].name, "ground");
    EXPECT_EQ(through("gltf = \"other.gltf\"").timeline.moving, 0);
    expectWithin(refusalThrough("gltf = \"other.gltf\"\nobject = 3"), "level.toml:2: object: expected a list");
    expectWithin(refusalThrough("gltf = \"none.glb\""), "none.glb");
    expectWithin(refusalThrough("title = \"x\"\nunit = \"cm\""), "level.toml:2: unit: belongs to gltf");
    expectWithin(refusalThrough("gltf = \"other.gltf\"\nlight = { kind = \"point\", center = [0, 1, 0] }"),
                 "level.toml:2: light");
}

TEST_F(GltfOfOthers, UnitAndAxisTurnAllOfIt) {
    const Scene scene = through("gltf = \"other.gltf\"\nunit = \"cm\"\nup = \"z\"");
    EXPECT_LT(glm::distance(scene.camera.eye, glm::dvec3(0, 0, -0.05)), 1e-15) << "y of the file looks away";
    EXPECT_LT(glm::distance(scene.camera.basis().forward, glm::dvec3(0, 0, 1)), 1e-12);
    EXPECT_DOUBLE_EQ(scene.camera.near, 0.001);
    EXPECT_DOUBLE_EQ(scene.camera.far, 0.2);
    EXPECT_LT(glm::distance(scene.light.centre, glm::dvec3(0.01, 0, -0.04)), 1e-15);
    EXPECT_EQ(through("gltf = \"other.gltf\"\nunit = \"ft\"").light.centre, glm::dvec3(0.3048, 4 * 0.3048, 0));
    EXPECT_EQ(through("gltf = \"other.gltf\"\nup = \"z\"").light.centre, glm::dvec3(1, 0, -4));
    EXPECT_LT(glm::distance(corner(scene.objects.at(0), 0, 1), glm::dvec3(0, 0.02, -0.005)), 1e-9);
}

TEST_F(GltfOfOthers, ACameraWithoutEndSeesTheWholeScene) {
    gltf["cameras"][0]["perspective"].erase("zfar");
    gltf["cameras"][0]["perspective"].erase("aspectRatio");
    gltf["accessors"][0]["min"] = {-1, 0, -1};
    gltf["accessors"][0]["max"] = {1, 0, 1};
    const Scene scene = loaded(); // the eye is 4.5 above a square of side 4
    EXPECT_NEAR(scene.camera.far, 1.01 * std::sqrt(4.5 * 4.5 + 2 * 2 + 2 * 2), 1e-9);
    EXPECT_EQ(scene.size, glm::ivec2(256));
}

TEST_F(GltfOfOthers, WhatNoSceneHasIsNamedWithWhatToWrite) {
    const Json whole = gltf;
    gltf["extensions"]["KHR_lights_punctual"]["lights"][0] = {{"type", "spot"}, {"name", "Torch"}};
    expectRefused(
        "light \"Torch\" is of type spot, which no scene has; give it in a scene file without its cone: light = { kind "
        "= \"point\", centre = [1, 4, 0] }");
    EXPECT_EQ(through("gltf = \"other.gltf\"\nlight = { kind = \"point\", centre = [1, 4, 0] }").light.kind,
              LightKind::Point);
    gltf = whole;
    gltf["cameras"][0] = {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 1}, {"zfar", 9}}}};
    expectRefused("camera \"camera\" is not in perspective; give one that is in a scene file: camera = { eye = [0, 5, 0]");
    gltf = whole;
    gltf["materials"] = {{{"alphaMode", "BLEND"}}};
    gltf["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_EQ(loaded().objects.size(), 1U) << "glass is as opaque as all else";
    gltf = whole;
    gltf["meshes"][0]["primitives"][0]["mode"] = 3;
    expectRefused("no node of it shows a triangle; points and lines cast no shadow");
}

TEST_F(GltfOfOthers, AMistakeInAMeshIsNamedByTheMesh) {
    gltf["accessors"][0]["byteOffset"] = 0;
    gltf["accessors"][0]["count"] = 1;
    gltf["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}, {"mode", 5}};
    const std::string said = refusal();
    expectWithin(said, "other.gltf: object[1].mesh.file: mesh \"tri\": the mesh has no triangle");
    EXPECT_EQ(said.find("gltf:1"), std::string::npos) << "no line of the file";
}

} // namespace
} // namespace shadowbench
