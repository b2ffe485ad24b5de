// assimp, in the child that reads a mesh.
#include "base/error.h"
#include "base/limits.h"
#include "scene/meshes/foreign_mesh.h"

#include <array>
#include <assimp/BaseImporter.h>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>

namespace shadowbench {
namespace {

/// The one of assimp's importers that is asked, by its own name for itself.
struct Format {
    std::string_view extension, importer;
};

constexpr std::array<Format, 4> formats{{{".obj", "Wavefront Object Importer"},
                                         {".ply", "Stanford Polygon Library (PLY) Importer"},
                                         {".gltf", "glTF2 Importer"},
                                         {".glb", "glTF2 Importer"}}};

/// assimp's view of the world: the file and its buffers.
class HandedFiles final : public Assimp::IOSystem {
public:
    explicit HandedFiles(const ForeignMeshFile& file) : file_(file), name_(nameOf(file)) {}

    static std::string nameOf(const ForeignMeshFile& file) { return "mesh" + file.extension; }

    bool Exists(const char* name) const override { return find(name) != nullptr; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        const std::string* bytes = find(name);
        if (bytes == nullptr || mode[0] != 'r') return nullptr;
        constexpr std::string_view mark = "\xEF\xBB\xBF"; // of UTF-8, which some editors write before text
        const std::size_t start = bytes->starts_with(mark) ? mark.size() : 0;
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes->data()) + start,
                                          bytes->size() - start);
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    [[nodiscard]] const std::string* find(std::string_view name) const {
        if (name.starts_with("./")) name.remove_prefix(2);
        if (name == name_) return &file_.bytes;
        for (const auto& [buffer, bytes] : file_.buffers)
            if (name == buffer || "./" + std::string(name) == buffer) return &bytes;
        return nullptr;
    }

    const ForeignMeshFile& file_;
    std::string name_;
};

/// Takes all importers but `kept` from assimp: what is not there cannot be tricked.
void keepOnly(Assimp::Importer& importer, std::string_view kept) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* description = importer.GetImporterInfo(i);
        if (description != nullptr && description->mName == kept) continue;
        Assimp::BaseImporter* other = importer.GetImporter(i);
        importer.UnregisterLoader(other);
        delete other; // which assimp leaves to us
    }
}

const char* const noTriangle = "it holds no triangle: points and lines cast no shadow";

std::string_view importerFor(const std::string& extension) {
    for (const Format& format : formats)
        if (format.extension == extension) return format.importer;
    throw BadInput("it is no .obj, .ply, .gltf or .glb file");
}

void requireCounts(const aiScene& scene) {
    std::uint64_t vertices = 0, faces = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        vertices += scene.mMeshes[i]->mNumVertices;
        faces += scene.mMeshes[i]->mNumFaces;
    }
    if (vertices > limitOf(Limit::Vertices))
        throw BadInput(fmt::format("it has {} vertices, {}", vertices, beyond(Limit::Vertices)));
    if (faces > limitOf(Limit::Triangles))
        throw BadInput(fmt::format("it has {} triangles, {}", faces, beyond(Limit::Triangles)));
}

void addTriangles(Mesh& mesh, const aiMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        const aiVector3D& v = part.mVertices[i];
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) // which no order of positions has a place for
            throw BadInput(fmt::format("position {} is not finite: ({:g}, {:g}, {:g})", first + i, v.x, v.y, v.z));
        mesh.positions.emplace_back(v.x, v.y, v.z);
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        if (face.mNumIndices != 3) continue; // points and lines cast no shadow
        for (unsigned corner = 0; corner < 3; ++corner)
            if (face.mIndices[corner] >= part.mNumVertices)
                throw BadInput(fmt::format("a triangle uses vertex {} of {}", face.mIndices[corner], part.mNumVertices));
        mesh.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]);
    }
}

} // namespace

void requireMeshExtension(const std::string& extension) { importerFor(extension); }

Mesh compacted(const Mesh& mesh) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
    Mesh result{{}, {}, mesh.closed, mesh.flat};
    for (const glm::uvec3& t : mesh.triangles) {
        glm::uvec3 moved(0);
        for (int corner = 0; corner < 3; ++corner) {
            std::uint32_t& index = place[t[corner]];
            if (index == kUnused) {
                index = static_cast<std::uint32_t>(result.positions.size());
                result.positions.push_back(mesh.positions[t[corner]]);
            }
            moved[corner] = index;
        }
        result.triangles.push_back(moved);
    }
    return result;
}

Mesh readMeshHere(const ForeignMeshFile& file) {
    Assimp::Importer importer;
    keepOnly(importer, importerFor(file.extension));
    importer.SetIOHandler(new HandedFiles(file)); // which it deletes
    const aiScene* scene =
        importer.ReadFile(HandedFiles::nameOf(file), aiProcess_Triangulate | aiProcess_PreTransformVertices);
    if (scene == nullptr) {
        const std::string_view said = importer.GetErrorString();
        throw BadInput(said.starts_with("No output meshes") ? noTriangle : std::string(said));
    }
    requireCounts(*scene);
    Mesh mesh;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) addTriangles(mesh, *scene->mMeshes[i]);
    if (mesh.triangles.empty()) throw BadInput(noTriangle);
    return compacted(weld(mesh));
}

} // namespace shadowbench
