// Penumbra wedges and the edges that they stand on (Akenine-Möller, Assarsson 2002; course, Soft Shadow Volumes). No GL.
#pragma once

#include "scene/camera.h"
#include "techniques/shared/casters/shadow_volume.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

// What a mesh hides of a point light is counted in layers: of a closed mesh the triangles that face the light; of an open
// one, which may show the light its backs, the others, too, turned over.

/// An edge where layers end, directed so that they lie on its left as the light sees it.
struct LayerEdge {
    std::uint32_t from, to;    // the mesh's vertices
    std::uint32_t left, right; // its triangles on either side as the light sees them, EdgeMesh::none where there is none
    int layers;                // 1; 2 where an open mesh folds; 0 where none end
};

/// All edges where the layers of a mesh end: of a closed mesh its `silhouette`. `facing` is the mesh's for the light.
std::vector<LayerEdge> layerEdges(const EdgeMesh& mesh, const std::vector<bool>& facing);

/// The same for the middle of an area light, and those where layers may end for another point of it. `facingCorners` are the
/// mesh's for the corners of a parallelogram that bounds the light.
std::vector<LayerEdge> layerEdges(const EdgeMesh& mesh, const std::vector<bool>& facing,
                                  const std::vector<std::vector<bool>>& facingCorners);

/// How many layers the segment from `point` to `light` crosses; both in object space.
int layersBetween(const EdgeMesh& mesh, const std::vector<bool>& facing, const glm::dvec3& point, const glm::dvec3& light);

/// The parallelogram that bounds a light, and one of its two sides.
struct WedgeLight {
    glm::dvec3 centre, halfU, halfV;
    glm::dvec3 axis; // of unit length, at right angles to halfU and halfV, towards that side

    /// `side` is 1 or −1. The light must have a width and a height.
    WedgeLight(const Light& light, int side);

    /// Metres from the light's plane, on that side.
    [[nodiscard]] double depth(const glm::dvec3& point) const;
};

/// Corners of a wedge: the ends of an edge that is parallel to the light, and a hexagon at the far end.
using Wedge = std::array<glm::dvec3, 8>;

/// A convex body that holds all points between the depths `nearest` and `far` that see some of the light's parallelogram
/// before or behind an edge: the course's construction, in which the end that is farther away moves towards the light's
/// middle until both are equally far; then all its faces are plane. All around the edge it is thicker by a ten-thousandth of
/// the light's size, for the rounding of 32-bit floats. Nothing where no part of the edge lies between those depths.
std::optional<Wedge> wedgeOver(const WedgeLight& light, const glm::dvec3& from, const glm::dvec3& to, double nearest,
                               double far);

/// Triangles of a wedge's surface as indices of its corners, counter-clockwise from outside.
inline constexpr std::array<std::array<std::uint8_t, 3>, 12> wedgeTriangles{{{2, 3, 4},
                                                                             {2, 4, 5},
                                                                             {2, 5, 6},
                                                                             {2, 6, 7},
                                                                             {3, 2, 0},
                                                                             {4, 3, 0},
                                                                             {4, 0, 1},
                                                                             {5, 4, 1},
                                                                             {6, 5, 1},
                                                                             {7, 6, 1},
                                                                             {7, 1, 0},
                                                                             {2, 7, 0}}};

} // namespace shadowbench::techniques
