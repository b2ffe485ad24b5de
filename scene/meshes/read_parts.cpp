// The reader of a glTF file's primitives by name. assimp's rounds matrices and may reorder vertices; here each is as it lies
// in the file.
#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "scene/gltf_file.h"
#include "scene/mesh_faults.h"
#include "scene/meshes/gltf_masks.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <set>

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

/// Of texture coordinates, which may be shares of the largest whole number.
float coordinateAt(const char* bytes, int component) {
    if (component == kGltfFloat) {
        float value = 0;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    std::uint32_t value = 0;
    const std::size_t size = sizeOfComponent(component);
    if (size == 4) throw BadInput("its texture coordinates are whole numbers of 32 bits");
    std::memcpy(&value, bytes, size);
    return static_cast<float>(value) / static_cast<float>((1U << 8U * size) - 1);
}

/// The vertices of an accessor that `triangles` use, ascending: primitives may share one and use little of it each.
std::vector<std::uint32_t> usedOf(const std::vector<glm::uvec3>& triangles, std::size_t count) {
    std::vector<std::uint32_t> used;
    for (const glm::uvec3& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    if (!used.empty() && used.back() >= count)
        throw BadInput(fmt::format("a triangle uses position {} of {}; export it again", used.back(), count));
    return used;
}

/// The positions of the vertices `used`.
Mesh usedPart(const GltfElements& positions, std::vector<glm::uvec3> triangles, const std::vector<std::uint32_t>& used) {
    if (positions.component != kGltfFloat)
        throw BadInput("its positions are no 32-bit floats; export it without quantisation");
    Mesh mesh{std::vector<glm::vec3>(used.size()), std::move(triangles)};
    for (std::size_t i = 0; i < used.size(); ++i)
        std::memcpy(&mesh.positions[i], positions.first + used[i] * positions.stride, sizeof(glm::vec3));
    for (glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            t[corner] = static_cast<std::uint32_t>(std::ranges::lower_bound(used, t[corner]) - used.begin());
    return mesh;
}

std::vector<glm::vec2> coordinatesOf(const GltfElements& elements, const std::vector<std::uint32_t>& used) {
    std::vector<glm::vec2> coordinates;
    for (const std::uint32_t vertex : used) {
        if (vertex >= elements.count)
            throw BadInput(fmt::format("it has {} texture coordinates and a vertex {}", elements.count, vertex));
        const char* first = elements.first + vertex * elements.stride;
        coordinates.emplace_back(coordinateAt(first, elements.component),
                                 coordinateAt(first + sizeOfComponent(elements.component), elements.component));
    }
    return coordinates;
}

class PartReader {
public:
    explicit PartReader(const ForeignMeshFile& file) : buffers_(file), masks_(buffers_, file.maskTexels) {}

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
        Mesh welded = weld(mesh);
        welded.cards = mesh.cards;
        return welded;
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
        std::vector<glm::uvec3> triangles = trianglesOf(corners, mode);
        const std::vector<std::uint32_t> used = usedOf(triangles, positions.count);
        Mesh mesh = usedPart(positions, std::move(triangles), used);
        if (const std::optional<GltfMask>& mask = masks_.of(primitive)) return cut(mesh, *mask, primitive, used);
        return mesh;
    }

    Mesh cut(const Mesh& mesh, const GltfMask& mask, const GltfJson& primitive, const std::vector<std::uint32_t>& used) {
        requireNumbers(mesh, "its mesh"); // which may have no area otherwise
        MaskedMesh cards{mesh, std::vector<glm::vec2>(used.size()), mask.mask};
        if (!mask.coordinates.empty()) {
            const auto number = wholeNumber<std::size_t>(primitive.at("attributes").at(mask.coordinates));
            cards.uv = coordinatesOf(buffers_.elements(number, "VEC2"), used);
        }
        const Mesh left = cutByMask(cards);
        if (left.triangles.empty()) throw BadInput("its mask leaves nothing of it; is its alphaCutoff as it should be?");
        Mesh result = weld(compacted(left));
        if (!mask.coordinates.empty() && isKept(*mask.mask))
            result.cards = std::make_shared<const MaskedMesh>(std::move(cards));
        return result;
    }

    /// Masks are kept for who exports the scene, as many as one image may have pixels.
    bool isKept(const AlphaMask& mask) {
        if (kept_.contains(&mask)) return true;
        const auto pixels = static_cast<std::uint64_t>(mask.alpha.width()) * static_cast<std::uint64_t>(mask.alpha.height());
        if (pixels > pixels_) return false;
        pixels_ -= pixels;
        kept_.insert(&mask);
        return true;
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
    GltfMasks masks_;
    /// What we have exported must come back bit by bit; what modelling programs write has each corner of a sharp edge twice.
    bool isExported_ = buffers_.json().contains(GltfJson::json_pointer("/asset/extras/shadowbench"));
    std::uint64_t vertices_ = 0, triangles_ = 0, pixels_ = limitOf(Limit::Pixels);
    std::set<const AlphaMask*> kept_;
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
