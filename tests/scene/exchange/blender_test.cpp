// A scene that Blender has exported (tests/scene/exchange/blender_level.py) is where Blender says that it is.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "scene/load/load.h"
#include "scene/mesh_faults.h"

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

const std::filesystem::path made = SOURCE_FOLDER "/tests/scene/exchange/blender_level.glb";

class BlendersScene : public testing::Test {
protected:
    [[nodiscard]] Scene through(const std::string& lines) const {
        const std::filesystem::path file = folder_.path() / "level.toml";
        writeFile(file, "gltf = \"" + made.string() + "\"\n" + lines);
        return loadScene(file.string(), Profile::Gate);
    }

    const nlohmann::json said = nlohmann::json::parse(readFile(SOURCE_FOLDER "/tests/scene/exchange/blender_level.json"));

private:
    TemporaryFolder folder_;
};

glm::dvec3 vectorOf(const nlohmann::json& list) { return {list.at(0), list.at(1), list.at(2)}; }

/// Of an instance in the world.
Bounds boundsOf(const Mesh& mesh, const glm::dmat4& place) {
    Bounds box;
    for (const glm::vec3& p : mesh.positions) box.add(glm::dvec3(place * glm::dvec4(p, 1)));
    return box;
}

TEST_F(BlendersScene, HasEachPartWhereBlenderHasIt) {
    constexpr double rounding = 2e-6; // of Blender's own matrices, which are of 32-bit floats, some metres from the origin
    const Scene scene = through("camera = \"Entrance\"\nlight = \"Lamp\"");
    std::size_t instances = 0;
    for (const Object& object : scene.objects)
        for (const Instance& instance : object.instances) {
            ++instances;
            const Mesh& mesh = *object.levels[0].mesh;
            const Bounds box = boundsOf(mesh, instance.place);
            const auto isIt = [&](const nlohmann::json& part) {
                return glm::distance(box.low, vectorOf(part["low"])) < rounding &&
                       glm::distance(box.high, vectorOf(part["high"])) < rounding &&
                       glm::distance(glm::dvec3(object.colour), vectorOf(part["colour"])) < 1e-6 &&
                       mesh.triangles.size() == part["triangles"].get<std::size_t>();
            };
            EXPECT_EQ(std::ranges::count_if(said["parts"], isIt), 1)
                << object.name << " from " << box.low.x << " " << box.low.y << " " << box.low.z;
        }
    EXPECT_EQ(instances, said["parts"].size());
}

TEST_F(BlendersScene, HasTheChosenCameraAndLight) {
    const Scene scene = through("camera = \"Entrance\"\nlight = \"Lamp\"");
    EXPECT_LT(glm::distance(scene.camera.eye, vectorOf(said["eye"])), 1e-6);
    EXPECT_LT(glm::distance(scene.camera.basis().forward, vectorOf(said["forward"])), 1e-6);
    EXPECT_NEAR(scene.camera.fovy, said["fovy"].get<double>(), 1e-5);
    EXPECT_NEAR(scene.camera.far, 60, 1e-5);
    EXPECT_EQ(scene.size, glm::ivec2(384, 256));
    EXPECT_EQ(scene.light.kind, LightKind::Point);
    EXPECT_LT(glm::distance(scene.light.centre, vectorOf(said["lamp"])), 1e-6);
    const Scene sunny = through("camera = \"Entrance\"\nlight = \"Sun\"");
    EXPECT_EQ(sunny.light.kind, LightKind::Directional);
    EXPECT_LT(glm::distance(sunny.light.direction, vectorOf(said["sun"])), 1e-6);
}

/// The two halves of the mirrored cone close each other, and face outwards as they do in Blender.
TEST_F(BlendersScene, TurnsNothingInsideOut) {
    const Scene scene = through("camera = \"Entrance\"\nlight = \"Lamp\"");
    Mesh cone;
    for (const Object& object : scene.objects) {
        if (!object.name.starts_with("Mirrored")) continue;
        const auto before = static_cast<std::uint32_t>(cone.positions.size());
        const Mesh& half = *object.levels[0].mesh;
        cone.positions.insert(cone.positions.end(), half.positions.begin(), half.positions.end());
        for (const glm::uvec3& t : half.triangles) cone.triangles.push_back(t + before);
    }
    cone = weld(cone);
    EXPECT_TRUE(edgeFaultsOf(cone).closed());
    EXPECT_GT(signedVolume(cone), 0.1);
}

TEST_F(BlendersScene, AloneAsksWhichOfItsViewsIsMeant) {
    try {
        loadScene(made.string(), Profile::Gate);
        FAIL();
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("it has 2 cameras (\"Entrance\", \"Above\")"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace shadowbench
