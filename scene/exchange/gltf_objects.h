// The meshes of a glTF file as objects of a scene file. Only sources of this folder include this.
#pragma once

#include "scene/exchange/gltf.h"
#include "scene/exchange/gltf_document.h"
#include "scene/mesh.h"

#include <glm/mat3x3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::exchange {

class GltfObjects {
public:
    /// Both must outlive it.
    GltfObjects(const GltfDocument& gltf, const GltfUse& use);

    /// Each primitive of triangles of that mesh at a place. Nodes that follow each other with one mesh are instances of the
    /// same objects, so that instances keep the order of their nodes, and their numbers.
    void add(const Json& mesh, const glm::dmat4& world, const std::string& node);

    [[nodiscard]] bool empty() const { return objects_.empty(); }

    /// Around all of them, by what the file says of its positions; nothing where it leaves that out.
    [[nodiscard]] const std::optional<Bounds>& bounds() const { return bounds_; }

    toml::array take();

private:
    /// `stretch`: what a place does not hold.
    toml::table objectOf(std::size_t mesh, std::size_t primitive, const std::optional<glm::dmat3>& stretch,
                         const std::string& node) const;
    void addBounds(const Json& primitive, const glm::dmat4& world);

    const GltfDocument& gltf_;
    const GltfUse& use_;
    std::vector<std::vector<std::string>> names_; // of each mesh's primitives
    std::vector<toml::table> objects_;
    std::size_t first_ = 0; // object of the last mesh
    std::size_t lastMesh_ = 0;
    std::optional<glm::dmat3> lastStretch_;
    std::optional<Bounds> bounds_ = Bounds{};
};

} // namespace shadowbench::exchange
