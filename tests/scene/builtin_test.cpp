// The standard scenes in every profile, and what scenes promise to those who draw them.
#include "base/error.h"
#include "base/files.h"
#include "scene/load/load.h"
#include "scene/mesh_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace shadowbench {
namespace {

bool sameBatches(const Snapshot& a, const Snapshot& b) {
    if (a.batches.size() != b.batches.size()) return false;
    for (std::size_t i = 0; i < a.batches.size(); ++i) {
        const Batch &x = a.batches[i], &y = b.batches[i];
        if (x.mesh->positions != y.mesh->positions || x.mesh->triangles != y.mesh->triangles) return false;
        if (x.placements.size() != y.placements.size()) return false;
        for (std::size_t k = 0; k < x.placements.size(); ++k)
            if (x.placements[k].world != y.placements[k].world || x.placements[k].id != y.placements[k].id) return false;
    }
    return true;
}

TEST(SceneBuiltin, TheStandardScenesComeFirstInTheirOrder) {
    EXPECT_EQ(standardScenes(),
              (std::vector<std::string>{"dueling-frusta", "overlapping-occluders", "simple", "windmills", "trees"}));
    const std::vector<std::string> ids = builtinScenes();
    ASSERT_GE(ids.size(), 5U);
    EXPECT_EQ(std::vector<std::string>(ids.begin(), ids.begin() + 5), standardScenes());
    EXPECT_THROW(builtinSceneText("none"), BadInput);
}

// A technique with a history is no worse for its first frame. Scenes about motion score the frames in which something moves.
TEST(SceneBuiltin, HistoriesConvergeForAsLongAsInTheStandardScenes) {
    for (const std::string& id : builtinScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        if (scene.light.isEnvironment() || id.starts_with("moving-") || id == "light-jump") continue;
        EXPECT_EQ(scene.timeline.still, 60) << id;
    }
}

class StandardScenes : public testing::TestWithParam<std::tuple<std::string, Profile>> {
protected:
    [[nodiscard]] Scene load() const { return loadScene(std::get<0>(GetParam()), std::get<1>(GetParam())); }
};

TEST_P(StandardScenes, LoadAndSayWhatTheyShow) {
    const Scene scene = load();
    EXPECT_EQ(scene.id, std::get<0>(GetParam()));
    EXPECT_EQ(scene.profile, std::get<1>(GetParam()));
    EXPECT_GT(scene.shows.size(), 20U);
    EXPECT_FALSE(scene.tolerance.empty());
    const int side = scene.profile == Profile::Gate ? 256 : scene.profile == Profile::Standard ? 512 : 1024;
    EXPECT_EQ(scene.size, glm::ivec2(side, side));
    EXPECT_EQ(scene.timeline.still, 60);
    EXPECT_EQ(scene.timeline.moving, scene.light.isArea() ? 4 : 8);
}

TEST_P(StandardScenes, HaveClosedMeshesOnly) {
    for (const Object& object : load().objects) {
        for (const Level& level : object.levels) {
            EXPECT_TRUE(level.mesh->closed) << object.name;
            EXPECT_NO_THROW(requireWellFormed(*level.mesh, object.name));
        }
    }
}

TEST_P(StandardScenes, AreTheSameWhenLoadedTwice) { EXPECT_TRUE(sameBatches(snapshot(load(), 63), snapshot(load(), 63))); }

TEST_P(StandardScenes, HaveTheirTopOfTheGroundInYZero) {
    const Scene scene = load();
    const Bounds ground =
        transformed(scene.objects.front().levels.front().mesh->bounds(), scene.objects.front().instances[0].place);
    EXPECT_NEAR(ground.high.y, 0, 1e-8); // 0.1 as a float is 1.5·10⁻⁹ off
}

TEST_P(StandardScenes, StayBetweenNearAndFar) {
    const Scene scene = load();
    const Snapshot frame = snapshot(scene, 0);
    for (const glm::dvec3& corner : frame.bounds().corners())
        EXPECT_LT(frame.camera.project(corner, scene.size).z, scene.camera.far);
}

TEST_P(StandardScenes, KeepTheLightFrustumOverTheWholeSceneModerate) {
    const Snapshot frame = snapshot(load(), 0);
    if (frame.light.kind == LightKind::Directional) return;
    const Bounds box = frame.bounds();
    const glm::dvec3 axis = glm::normalize(box.centre() - frame.light.centre);
    for (const glm::dvec3& corner : box.corners())
        EXPECT_GT(glm::dot(axis, glm::normalize(corner - frame.light.centre)), std::cos(65 * std::acos(-1.0) / 180));
}

std::string nameOf(const testing::TestParamInfo<std::tuple<std::string, Profile>>& info) {
    std::string label = std::get<0>(info.param) + "_" + std::string(name(std::get<1>(info.param)));
    for (char& c : label)
        if (c == '-') c = '_';
    return label;
}

INSTANTIATE_TEST_SUITE_P(Scene, StandardScenes,
                         testing::Combine(testing::ValuesIn(standardScenes()),
                                          testing::Values(Profile::Gate, Profile::Standard, Profile::Paper)),
                         nameOf);

std::size_t instancesOf(const std::string& id, Profile profile) {
    std::size_t most = 0;
    for (const Object& object : loadScene(id, profile).objects) most = std::max(most, object.instances.size());
    return most;
}

TEST(SceneBuiltin, InstancedScenesHaveTheSeedsSizesInPaper) {
    for (const std::string id : {"simple", "windmills", "trees"}) {
        EXPECT_EQ(instancesOf(id, Profile::Paper), 4000U) << id;
        EXPECT_EQ(instancesOf(id, Profile::Standard), 400U) << id;
        EXPECT_LE(instancesOf(id, Profile::Gate), 36U) << id;
    }
}

TEST(SceneBuiltin, LevelsOfDetailSpanTheSeedsTriangleCounts) {
    const Scene windmills = loadScene("windmills", Profile::Paper), trees = loadScene("trees", Profile::Paper);
    const auto triangles = [](const Object& object, bool finest) {
        return static_cast<double>((finest ? object.levels.front() : object.levels.back()).mesh->triangles.size());
    };
    EXPECT_NEAR(triangles(windmills.objects[1], true) + triangles(windmills.objects[2], true), 18000, 1800);
    EXPECT_NEAR(triangles(windmills.objects[1], false) + triangles(windmills.objects[2], false), 100, 10);
    EXPECT_NEAR(triangles(trees.objects[1], true), 93000, 9300);
    EXPECT_NEAR(triangles(trees.objects[1], false), 5000, 500);
}

TEST(SceneBuiltin, OverlappingOccludersHasSeventyThousandTriangles) {
    for (const Profile profile : {Profile::Standard, Profile::Paper})
        EXPECT_NEAR(static_cast<double>(snapshot(loadScene("overlapping-occluders", profile), 0).triangles()), 70000, 1000);
}

TEST(SceneBuiltin, EveryRotorSitsOnItsTower) {
    const Scene scene = loadScene("windmills", Profile::Gate);
    const Object &towers = scene.objects[1], &rotors = scene.objects[2];
    ASSERT_EQ(towers.instances.size(), rotors.instances.size());
    for (std::size_t i = 0; i < towers.instances.size(); ++i) {
        const glm::dvec4 hub = towers.instances[i].place * glm::dvec4(0, 2.9, 0.72, 1);
        EXPECT_LT(glm::distance(hub, rotors.instances[i].place[3]), 1e-12);
    }
}

TEST(SceneBuiltin, TheViewMovesByOneToThreePixelsAFrameInGate) {
    for (const std::string& id : standardScenes()) {
        const Scene scene = loadScene(id, Profile::Gate);
        const Snapshot now = snapshot(scene, scene.timeline.still), before = snapshot(scene, scene.timeline.still - 1);
        const glm::dvec3 seen = before.camera.target; // in the middle of the image
        const glm::dvec2 step(now.camera.project(seen, scene.size) - before.camera.project(seen, scene.size));
        EXPECT_GE(glm::length(step), 1) << id;
        EXPECT_LE(glm::length(step), 3) << id;
    }
}

class MeshFiles : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Scene loadWithMesh(const std::string& mesh) const {
        writeFile(folder_ / "own.toml", "title = \"own\"\n"
                                        "camera = { eye = [0, 2, 9], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
                                        "light = { kind = \"point\", centre = [0, 9, 0] }\n[[object]]\nmesh = { " +
                                            mesh + " }\n");
        return loadScene((folder_ / "own.toml").string(), Profile::Gate);
    }

    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("shadowbench-mesh-" + std::to_string(::getpid()));
};

const char* const kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(MeshFiles, AreFoundBesideTheSceneAndWelded) {
    writeFile(folder_ / "t.obj", kTetrahedron);
    const Scene scene = loadWithMesh("file = \"t.obj\", closed = true");
    const Mesh& mesh = *scene.objects[0].levels[0].mesh;
    EXPECT_TRUE(mesh.closed);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.positions.size(), 4U);
}

/// Corners of a box of 1 × 2 × 3 m, its faces outwards.
const char* const kFaces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

std::string boxWith(const std::function<std::array<double, 3>(double, double, double)>& corner, const std::string& faces) {
    std::string text;
    for (const double z : {0.0, 3.0})
        for (const double y : {0.0, 2.0})
            for (const double x : {0.0, 1.0}) {
                const auto [a, b, c] = corner(x, y, z);
                text += fmt::format("v {} {} {}\n", a, b, c);
            }
    return text + faces;
}

/// Of what the scene has: metres, +y up, faces outwards.
TEST_F(MeshFiles, OfOtherUnitsAxesAndWindingsBecomeTheSameMesh) {
    const char* const inwards = "f 2 4 3 1\nf 7 8 6 5\nf 5 6 2 1\nf 4 8 7 3\nf 3 7 5 1\nf 6 8 4 2\n";
    writeFile(folder_ / "right.obj", boxWith([](double x, double y, double z) { return std::array{x, y, z}; }, kFaces));
    const auto meshOf = [&](const std::string& words) {
        return *loadWithMesh(words + ", closed = true").objects[0].levels[0].mesh;
    };
    const Mesh right = meshOf("file = \"right.obj\"");
    for (const auto& [unit, perMetre] : {std::pair("m", 1.0), std::pair("cm", 100.0), std::pair("mm", 1000.0),
                                         std::pair("in", 1 / 0.0254), std::pair("ft", 1 / 0.3048)}) {
        writeFile(folder_ / "other.obj", boxWith(
                                             [&](double x, double y, double z) { // z up, as a modelling program turns it
                                                 return std::array{perMetre * x, -perMetre * z, perMetre * y};
                                             },
                                             inwards));
        const Mesh mesh = meshOf(fmt::format("file = \"other.obj\", unit = \"{}\", up = \"z\", flip = true", unit));
        ASSERT_EQ(mesh.triangles.size(), right.triangles.size());
        EXPECT_NEAR(signedVolume(mesh), 6, 1e-5) << unit;
        ASSERT_EQ(mesh.positions.size(), 8U);
        for (const glm::vec3& wanted : right.positions)
            EXPECT_TRUE(std::ranges::any_of(mesh.positions, [&](const glm::vec3& p) {
                return glm::distance(p, wanted) < 1e-6F;
            })) << unit;
    }
    EXPECT_THROW(meshOf("file = \"other.obj\", unit = \"ft\", up = \"z\""), BadInput) << "inside out";
    EXPECT_THROW(meshOf("file = \"right.obj\", unit = \"km\""), BadInput);
    EXPECT_THROW(loadWithMesh("box = { size = [1, 1, 1] }, unit = \"cm\""), BadInput);
}

TEST_F(MeshFiles, ThatAreSaidToBeClosedMustBe) {
    writeFile(folder_ / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_NO_THROW(loadWithMesh("file = \"open.obj\""));
    try {
        loadWithMesh("file = \"open.obj\", closed = true");
        FAIL() << "loaded";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("own.toml:5: object[1].mesh.file: not closed"), std::string::npos)
            << error.what();
    }
}

TEST_F(MeshFiles, ThatCannotBeUnderstoodAreNamed) {
    writeFile(folder_ / "junk.ply", "not a mesh");
    writeFile(folder_ / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    EXPECT_THROW(loadWithMesh("file = \"junk.ply\""), BadInput);
    EXPECT_THROW(loadWithMesh("file = \"flat.obj\""), BadInput);
    EXPECT_THROW(loadWithMesh("file = \".\""), BadInput);
}

TEST_F(MeshFiles, AreSimplifiedOnRequest) {
    std::string grid;
    constexpr int kSide = 21;
    for (int i = 0; i < kSide * kSide; ++i)
        grid += "v " + std::to_string(i % kSide) + " 0 " + std::to_string(i / kSide) + "\n";
    for (int i = 0; i + 1 < kSide; ++i) {
        for (int j = 1; j < kSide; ++j) {
            const int a = i * kSide + j, b = a + kSide;
            grid += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + " " +
                    std::to_string(a + 1) + "\n";
        }
    }
    writeFile(folder_ / "grid.obj", grid);
    EXPECT_EQ(loadWithMesh("file = \"grid.obj\"").objects[0].levels[0].mesh->triangles.size(), 800U);
    EXPECT_LE(loadWithMesh("file = \"grid.obj\", simplify = 200").objects[0].levels[0].mesh->triangles.size(), 200U);
}

} // namespace
} // namespace shadowbench
