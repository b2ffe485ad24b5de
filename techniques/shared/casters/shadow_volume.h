// Silhouettes and shadow-volume geometry (Everitt–Kilgard, course; Zápotocký 2.4). No GL.
#pragma once

#include "scene/mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

namespace shadowbench::techniques {

/// A mesh with its edges and its box: made once per mesh.
class EdgeMesh {
public:
    explicit EdgeMesh(const Mesh& mesh);

    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// Directed as in triangle `left`; `right` is the triangle on the other side, or `none` at a border.
    struct Edge {
        std::uint32_t from, to;
        std::uint32_t left, right;
    };

    [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
    [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; } // of the mesh

    /// For each triangle whether it faces the homogeneous light `light` (object space): A·L > 0 with the triangle's plane A.
    /// Edge-on counts as facing away.
    [[nodiscard]] std::vector<bool> facing(const glm::dvec4& light) const;

private:
    const Mesh* mesh_;
    Bounds bounds_;
    std::vector<Edge> edges_;
};

/// Possible silhouette edges: those between a facing and an averted triangle, directed as in the facing one; a border edge
/// of a facing triangle is one too.
std::vector<std::pair<std::uint32_t, std::uint32_t>> silhouette(const EdgeMesh& mesh, const std::vector<bool>& facing);

/// What closes a volume's sides: at the front facing triangles, at infinity averted ones.
enum class Caps { None, Front, Both };

/// Triangles of the shadow volume as indices into the mesh's vertices; index + vertexCount is the same vertex projected to
/// infinity away from the light. With caps, facing triangles close it at the front; averted ones, projected, close it at
/// infinity if both are asked for, except for a directional light, whose volume ends in a point there. The caps' indices
/// come first; returns how many they are.
std::size_t appendShadowVolume(const EdgeMesh& mesh, const glm::dvec4& light, Caps caps,
                               std::vector<std::uint32_t>& indices);

/// The projection `projection` (perspective) with its far plane moved to infinity: P_inf (Everitt–Kilgard 3.2.1).
glm::dmat4 infiniteProjection(const glm::dmat4& projection, double near);

} // namespace shadowbench::techniques
