// The reader of a glTF file's primitives by name. assimp's rounds matrices and may reorder vertices; here each is as it lies
// in the file.
#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "scene/gltf_file.h"
#include "scene/mesh_faults.h"
#include "scene/meshes/gltf_buffers.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <numeric>

namespace shadowbench {
namespace {

enum Mode : std::size_t { List = 4, Strip = 5, Fan = 6 }; // of a primitive; below are points and lines

std::vector<glm::uvec3> trianglesOf(const std::vector<std::uint32_t>& corners, std::size_t mode) {
    std::vector<glm::uvec3> triangles;
    if (mode > Fan) throw BadInput(fmt::format("glTF has no mode {}", mode));
    if (mode == List && corners.size() % 3 != 0)
        throw BadInput(fmt::format("its {} corners are no list of triangles; export it again", corners.size()));
    for (std::size_t i = 0; i + 2 < corners.size(); i += mode == List ? 3 : 1) {
        const std::uint32_t a = corners[i], b = corners[i + 1], c = corners[i + 2];
        if (mode == Fan)
            triangles.emplace_back(b, c, corners[0]);
        else if (mode == Strip && i % 2 == 1)
            triangles.emplace_back(a, c, b);
        else
            triangles.emplace_back(a, b, c);
    }
    return triangles;
}

std::vector<std::uint32_t> indicesOf(const GltfElements& elements) {
    if (elements.component == kGltfFloat) throw BadInput("its indices are no whole numbers");
    std::vector<std::uint32_t> indices(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) // little-endian, as glTF's buffers are
        std::memcpy(&indices[i], elements.first + i * elements.stride, sizeOfComponent(elements.component));
    return indices;
}

/// The positions that `triangles` use, in their order: primitives may share an accessor and use little of it each.
Mesh usedPart(const GltfElements& positions, std::vector<glm::uvec3> triangles) {
    if (positions.component != kGltfFloat)
        throw BadInput("its positions are no 32-bit floats; export it without quantisation");
    std::vector<std::uint32_t> used;
    for (const glm::uvec3& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!used.empty() && used.back() >= positions.count)
        throw BadInput(fmt::format("a triangle uses position {} of {}; export it again", used.back(), positions.count));
    Mesh mesh{std::vector<glm::vec3>(used.size()), std::move(triangles)};
    for (std::size_t i = 0; i < used.size(); ++i)
        std::memcpy(&mesh.positions[i], positions.first + used[i] * positions.stride, sizeof(glm::vec3));
    for (glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            t[corner] = static_cast<std::uint32_t>(std::ranges::lower_bound(used, t[corner]) - used.begin());
    return mesh;
}

class PartReader {
public:
    explicit PartReader(const ForeignMeshFile& file) : buffers_(file) {}

    std::map<std::string, Mesh> parts() {
        std::map<std::string, Mesh> result;
        const GltfJson& meshes = gltfList(buffers_.json(), "meshes");
        PartNames names;
        for (std::size_t number = 0; number < meshes.size(); ++number) {
            const std::string mesh = meshes[number].value("name", std::string());
            for (const GltfJson& primitive : gltfList(meshes[number], "primitives")) {
                const std::string name = names.next(mesh, number);
                if (auto part = read(primitive, name)) result.emplace(name, std::move(*part));
            }
        }
        return result;
    }

private:
    /// Nothing for points and lines.
    std::optional<Mesh> read(const GltfJson& primitive, const std::string& name) {
        const std::size_t mode = gltfWhole(primitive, "mode", List);
        if (mode < List) return std::nullopt;
        const std::string what = fmt::format("mesh \"{}\"", name);
        Mesh mesh;
        try {
            mesh = triangleMesh(primitive, mode);
            requireRoom(mesh);
        } catch (const BadInput& error) {
            throw BadInput(fmt::format("{}: {}", what, error.what()));
        }
        if (isExported_) return mesh;
        requireNumbers(mesh, what); // which weld compares
        return weld(mesh);
    }

    Mesh triangleMesh(const GltfJson& primitive, std::size_t mode) {
        const auto number = wholeNumber<std::size_t>(primitive.at("attributes").at("POSITION"));
        const GltfElements positions = buffers_.elements(number, "VEC3");
        std::vector<std::uint32_t> corners;
        if (primitive.contains("indices")) {
            corners = indicesOf(buffers_.elements(wholeNumber<std::size_t>(primitive["indices"]), "SCALAR"));
        } else {
            corners.resize(positions.count);
            std::iota(corners.begin(), corners.end(), 0U);
        }
        return usedPart(positions, trianglesOf(corners, mode));
    }

    /// Of all parts together.
    void requireRoom(const Mesh& another) {
        vertices_ += another.positions.size();
        triangles_ += another.triangles.size();
        if (vertices_ > limitOf(Limit::Vertices))
            throw BadInput(fmt::format("with it the file has {} vertices, {}", vertices_, beyond(Limit::Vertices)));
        if (triangles_ > limitOf(Limit::Triangles))
            throw BadInput(fmt::format("with it the file has {} triangles, {}", triangles_, beyond(Limit::Triangles)));
    }

    GltfBuffers buffers_;
    /// What we have exported must come back bit by bit; what modelling programs write has each corner of a sharp edge twice.
    bool isExported_ = buffers_.json().contains(GltfJson::json_pointer("/asset/extras/shadowbench"));
    std::uint64_t vertices_ = 0, triangles_ = 0;
};

} // namespace

std::map<std::string, Mesh> readPartsHere(const ForeignMeshFile& file) {
    try {
        return PartReader(file).parts();
    } catch (const nlohmann::json::exception& error) {
        throw BadInput(fmt::format("a value is missing or of another kind than glTF asks for ({})", error.what()));
    }
}

} // namespace shadowbench
