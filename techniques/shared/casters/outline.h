// The outlines of casters as the light's centre sees them: where what covers a shadow map from both sides may end. No GL.
#pragma once

#include "scene/camera.h"
#include "techniques/shared/casters/shadow_volume.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::techniques {

/// Directed as the mesh's edge is.
struct OutlineEdge {
    std::uint32_t from, to;
    bool casterOnRight; // as the light sees it, else on the left: on the side of the edge's triangles
};

/// Edges of a mesh where its outline may run: between a facing and an averted triangle, and all borders of an open mesh.
std::vector<OutlineEdge> outline(const EdgeMesh& mesh, const std::vector<bool>& facing);

/// World to the light's own metres: right along u, up, and away from its plane along `axis` (unit length, at right angles
/// to u), from its centre. Seen along the axis, right and up are those of an image.
glm::dmat4 lightFromWorld(const Light& light, const glm::dvec3& axis);

/// A place on an outline: in the caster's own coordinates and in the light's (`lightFromWorld`).
struct OutlinePoint {
    glm::dvec3 object, seen;

    /// In the light's image: the plane at unit distance.
    [[nodiscard]] glm::dvec2 image() const { return glm::dvec2(seen) / seen.z; }
};

/// An edge before the light, the caster on its left.
struct OutlineSegment {
    OutlinePoint from, to;
    std::uint32_t first, last; // the mesh's vertices that it runs between; EdgeMesh::none where that end is cut off
    glm::dvec2 outward;        // in the light's image: of unit length, at right angles to the edge, away from the caster
};

/// A vertex where the outline turns around the caster, the caster within the turn.
struct OutlineCorner {
    OutlinePoint at;
    glm::dvec2 outward; // of the segment that ends here
    double turn;        // from there to that of the segment that begins here: radians in (0, π], counter-clockwise
};

struct SeenOutline {
    std::vector<OutlineSegment> segments;
    std::vector<OutlinePoint> vertices; // of the mesh, each once: where segments begin or end

    /// The corners of a convex outline are all its vertices; where it turns the other way there is none. Where several
    /// segments begin at a vertex, one that ends there is continued by the one that turns least.
    [[nodiscard]] std::vector<OutlineCorner> corners() const;
};

/// The outline of a mesh that `lightFromObject` places, without mirroring it, in the coordinates of the light. What lies
/// nearer to the light's plane than `nearest` > 0 is cut off, and so is an edge that runs towards the light.
SeenOutline seenOutline(const EdgeMesh& mesh, const glm::dmat4& lightFromObject, double nearest);

} // namespace shadowbench::techniques
