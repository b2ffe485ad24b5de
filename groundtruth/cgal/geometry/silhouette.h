// Silhouette chains: of all edges of an occluder only those remain at which the number of covering triangles changes.
#pragma once

#include "groundtruth/cgal/geometry/mesh_edges.h"
#include "groundtruth/cgal/geometry/projection.h"
#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/geometry/winding.h"

#include <vector>

namespace shadowbench::groundtruth::geometry {

/// An edge's point by vertex indices of the mesh, as EdgePoint; a = b for a vertex.
struct ChainPoint {
    std::uint32_t a, b;
    EdgePointKind kind;
};

/// A directed edge: to its left, seen from the light, `covers` more triangles lie than to its right. Edges at the light's
/// level have their shadow at infinity. Where a mesh rests on the receiver's plane there are edges (and points: both ends
/// the same) that cover 0: points of the plane on them lie on the triangles there, which do not cover them.
struct ChainEdge {
    ChainPoint from, to;
    int covers;
    bool atLightLevel;
};

/// The silhouette and border edges of one instance as the light sees it. Their winding number is the number of triangles
/// between a point of the receiver's plane and the light, for closed, open and broken meshes alike.
struct Chains {
    std::vector<ChainEdge> edges;
    std::vector<std::uint32_t> grounded; // triangles of the mesh that occlude and touch or cross the receiver's plane
};

/// Of an instance between the receiver's plane and the light's level. `edges` are those of its mesh.
Chains wholeChains(const TriangleInstance& instance, const MeshEdges& edges, const glm::dvec4& light, int threads);

/// Of the part of an instance that lies between the plane of `plane` and the light's level.
Chains clippedChains(const TriangleInstance& instance, const MeshEdges& edges, const glm::dvec4& light,
                     const Triangle& plane, int threads);

/// The border of one occluding triangle as far as it lies between the plane and the light's level.
std::vector<SpatialEdge> borderOf(const TriangleInstance& instance, std::uint32_t triangle, const glm::dvec4& light,
                                  const Triangle& plane);

SpatialEdge spatialEdge(const TriangleInstance& instance, const ChainEdge& edge);

/// The same edge on the receiver's plane. Towards the light's level it is not cut: one end may lie above the light.
struct ShadowEdge {
    ShadowVertex from, to;
    int covers;
};
ShadowEdge shadowEdge(const TriangleInstance& instance, const ChainEdge& edge, const ShadowProjection& projection);

/// Does the shadow of the edge, and of the whole mesh's edge that it is part of, surely miss the image?
bool missesImage(const TriangleInstance& instance, const ChainEdge& edge, const ShadowProjection& projection);

/// The shadow's edges of one instance, but for those at infinity.
std::vector<ShadowEdge> silhouette(const TriangleInstance& instance, const glm::dvec4& light,
                                   const ShadowProjection& projection);

} // namespace shadowbench::groundtruth::geometry
