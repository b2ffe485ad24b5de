#include "scene/meshes/import.h"

#include "base/error.h"
#include "base/files.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>
#include <meshoptimizer.h>

namespace shadowbench {
namespace {

void addTriangles(Mesh& mesh, const aiMesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned i = 0; i < part.mNumVertices; ++i)
        mesh.positions.emplace_back(part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z);
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        if (face.mNumIndices == 3) // points and lines cast no shadow
            mesh.triangles.emplace_back(first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]);
    }
}

/// Drops the positions that no triangle uses.
Mesh compacted(const Mesh& mesh) {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
    Mesh result{{}, {}, mesh.closed};
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

} // namespace

Mesh importMesh(const std::filesystem::path& file) {
    readFile(file); // assimp's own message for a missing file does not name the reason
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
    if (scene == nullptr) throw BadInput(fmt::format("cannot import mesh {}: {}", file.string(), importer.GetErrorString()));
    Mesh mesh;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) addTriangles(mesh, *scene->mMeshes[i]);
    if (mesh.triangles.empty()) throw BadInput(fmt::format("cannot import mesh {}: it holds no triangle", file.string()));
    return compacted(weld(mesh));
}

Mesh simplified(const Mesh& mesh, int triangles) {
    if (mesh.triangles.size() <= static_cast<std::size_t>(triangles)) return mesh;
    std::vector<unsigned> indices;
    for (const glm::uvec3& t : mesh.triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
    std::vector<unsigned> kept(indices.size());
    constexpr float kAnyError = std::numeric_limits<float>::max(); // the count decides, not the error
    kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(glm::vec3), 3 * static_cast<std::size_t>(triangles), kAnyError, 0, nullptr));
    Mesh result{mesh.positions, {}, mesh.closed};
    for (std::size_t i = 0; i + 2 < kept.size(); i += 3) result.triangles.emplace_back(kept[i], kept[i + 1], kept[i + 2]);
    return compacted(result);
}

} // namespace shadowbench
