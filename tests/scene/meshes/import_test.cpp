// Meshes from files: the same bits as ever from sound ones, one line from all others.
#include "base/error.h"
#include "base/files.h"
#include "base/random.h"
#include "base/temporary_folder.h"
#include "scene/meshes/foreign_mesh.h"
#include "scene/meshes/import.h"
#include "scene/meshes/primitives.h"

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

template <typename T>
void addBytes(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string objOf(const Mesh& mesh) {
    std::string text;
    for (const glm::vec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::uvec3& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return text;
}

std::string plyOf(const Mesh& mesh) {
    std::string bytes =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                    "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                    mesh.positions.size(), mesh.triangles.size());
    for (const glm::vec3& p : mesh.positions) addBytes(bytes, p);
    for (const glm::uvec3& t : mesh.triangles) {
        bytes += '\3';
        addBytes(bytes, t);
    }
    return bytes;
}

std::string binOf(const Mesh& mesh) {
    std::string bytes;
    for (const glm::vec3& p : mesh.positions) addBytes(bytes, p);
    for (const glm::uvec3& t : mesh.triangles) addBytes(bytes, t);
    return bytes;
}

/// `uri`: of the buffer.
std::string gltfOf(const Mesh& mesh, const std::string& uri) {
    const std::size_t first = mesh.positions.size() * sizeof(glm::vec3), second = mesh.triangles.size() * sizeof(glm::uvec3);
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],)"
        R"("meshes":[{{"name":"ball","primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
        R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3","min":[-9,-9,-9],"max":[9,9,9]}},)"
        R"({{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],)"
        R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
        R"("buffers":[{{"byteLength":{},"uri":"{}"}}]}})",
        mesh.positions.size(), 3 * mesh.triangles.size(), first, first, second, first + second, uri);
}

class Import : public testing::Test {
protected:
    fs::path write(const std::string& name, const std::string& bytes) const {
        writeFile(folder_.path() / name, bytes);
        return folder_.path() / name;
    }
    fs::path gltf(const std::string& uri) const { return write("ball.gltf", gltfOf(ball_, uri)); }

    /// What the importer says of a file, without its folder; "" where it is read.
    std::string refusal(const fs::path& file) const {
        try {
            importMesh(file);
        } catch (const BadInput& error) {
            std::string text = error.what();
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            EXPECT_NE(text.find(file.filename().string()), std::string::npos) << text;
            return text;
        }
        return "";
    }
    void expectRefusal(const fs::path& file, const std::string& why) const {
        const std::string said = refusal(file);
        EXPECT_NE(said.find(why), std::string::npos) << why << " in: " << said;
    }

    TemporaryFolder folder_;
    const Mesh ball_ = sphere(1, 80);
};

void expectSame(const Mesh& one, const Mesh& other) {
    EXPECT_EQ(one.positions, other.positions);
    EXPECT_EQ(one.triangles, other.triangles);
}

TEST_F(Import, FromEachFormatGivesWhatTheLibraryGivesToTheBit) {
    const fs::path buffer = write("ball.bin", binOf(ball_));
    for (const fs::path& file : {write("ball.obj", objOf(ball_)), write("ball.PLY", plyOf(ball_)), gltf("ball.bin")}) {
        std::string extension = file.extension() == ".PLY" ? ".ply" : file.extension().string();
        const ForeignMeshFile here{extension, readFile(file), {{"ball.bin", readFile(buffer)}}};
        const Mesh mesh = importMesh(file);
        EXPECT_EQ(mesh.triangles.size(), ball_.triangles.size()) << file;
        expectSame(mesh, readMeshHere(here));
    }
    // A writer of shortest decimals loses nothing, and vertices come in the order in which faces name them.
    EXPECT_EQ(importMesh(folder_.path() / "ball.PLY").bounds().high, ball_.bounds().high);
}

TEST_F(Import, OfPartsGivesEachAsItLiesInTheFile) {
    write("ball.bin", binOf(ball_));
    const std::map<std::string, Mesh> parts = importParts(gltf("ball.bin"));
    ASSERT_EQ(parts.size(), 1U);
    expectSame(parts.at("ball"), ball_);
}

TEST_F(Import, ReadsBuffersBelowTheFolderOfAGltfAndNoOthers) {
    write("inner/ball.bin", binOf(ball_));
    EXPECT_EQ(refusal(gltf("inner/ball.bin")), "");
    EXPECT_EQ(refusal(gltf("./inner/ball.bin")), "");
    const TemporaryFolder elsewhere;
    writeFile(elsewhere.path() / "ball.bin", binOf(ball_));
    fs::create_symlink(elsewhere.path() / "ball.bin", folder_.path() / "link.bin");
    const auto said = [&](const std::string& uri) {
        const fs::path file = gltf(uri);
        try {
            importMesh(file);
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(said((elsewhere.path() / "ball.bin").string()).find("is no relative path"), std::string::npos);
    EXPECT_NE(said("../" + elsewhere.path().filename().string() + "/ball.bin").find("without \"..\""), std::string::npos);
    EXPECT_NE(said("link.bin").find("symbolic link"), std::string::npos);
    EXPECT_NE(said("none.bin").find("none.bin: No such file"), std::string::npos);
}

TEST_F(Import, KnowsThreeFormatsByTheirNames) {
    expectRefusal(write("ball.stl", "solid\nendsolid\n"), "it is no .obj, .ply, .gltf or .glb file");
    expectRefusal(write("ball", objOf(ball_)), "it is no .obj");
    EXPECT_NE(refusal(write("stl.obj", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                                       "endloop\nendfacet\nendsolid x\n")),
              "");
}

TEST_F(Import, HoldsFilesToTheirLimits) {
    ::setenv("SHADOWBENCH_MAX_TRIANGLES", "79", 1);
    expectRefusal(write("ball.obj", objOf(ball_)), "it has 80 triangles, more than the 79 of SHADOWBENCH_MAX_TRIANGLES");
    ::unsetenv("SHADOWBENCH_MAX_TRIANGLES");
    std::string deep = R"({"asset":{"version":"2.0"},"extras":)";
    for (int i = 0; i < 100'000; ++i) deep += "[";
    expectRefusal(write("deep.gltf", deep), "its lists and objects are nested 65 deep");
    std::string many = R"({"asset":{"version":"2.0"},"buffers":[)";
    for (int i = 0; i < 70; ++i) many += fmt::format(R"({}{{"uri":"{}.bin"}})", i > 0 ? "," : "", i);
    expectRefusal(write("many.gltf", many + "]}"), "it needs more than 63 files");
}

TEST_F(Import, NamesWhatIsNoMesh) {
    expectRefusal(write("empty.obj", ""), "cannot import mesh");
    expectRefusal(write("points.obj", "v 0 0 0\nv 1 0 0\n"), "cannot import mesh");
    expectRefusal(write("points.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                      "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n"),
                  "it holds no triangle: points and lines cast no shadow");
    expectRefusal(write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "cannot import mesh");
    expectRefusal(folder_.path() / "none.ply", "No such file");
}

/// assimp 5.2.5 looks for the end of this header for ever.
TEST_F(Import, NamesAFileThatTheLibraryHangsOn) {
    ::setenv("SHADOWBENCH_MAX_READER_SECONDS", "1", 1);
    expectRefusal(write("endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
                  "or raise SHADOWBENCH_MAX_READER_SECONDS");
    ::unsetenv("SHADOWBENCH_MAX_READER_SECONDS");
}

/// A file with a few bytes changed is read or named; the library's aborts, crashes and endless loops stay in its child.
class ChangedFiles : public Import, public testing::WithParamInterface<const char*> {};

TEST_P(ChangedFiles, AreReadOrNamed) {
    ::setenv("SHADOWBENCH_MAX_READER_SECONDS", "2", 1);
    write("ball.bin", binOf(ball_));
    const std::string extension = GetParam();
    const std::string sound = extension == ".obj"   ? objOf(ball_)
                              : extension == ".ply" ? plyOf(ball_)
                                                    : gltfOf(ball_, "ball.bin");
    constexpr int files = 12;
    Random random(20);
    for (int i = 0; i < files; ++i) {
        std::string changed = sound;
        for (int change = 0; change < 4; ++change) {
            const std::size_t reach = change < 3 ? std::min<std::size_t>(changed.size(), 300) : changed.size(); // of headers
            const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(reach)));
            changed.at(at) = static_cast<char>(random.uniform(0, 256));
        }
        EXPECT_NO_THROW(refusal(write(fmt::format("changed-{}{}", i, extension), changed)));
    }
    ::unsetenv("SHADOWBENCH_MAX_READER_SECONDS");
}

INSTANTIATE_TEST_SUITE_P(Formats, ChangedFiles, testing::Values(".obj", ".ply", ".gltf"),
                         [](const testing::TestParamInfo<const char*>& format) { return std::string(format.param + 1); });

} // namespace
} // namespace shadowbench
