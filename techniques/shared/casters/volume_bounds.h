// Where a caster's shadow volume may lie, and whether what is seen may lie in it. No GL.
#pragma once

#include "scene/camera.h"
#include "scene/mesh.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// All points p + t · d of points p and directions d between and among those given, with t ≥ 0: a convex body, unbounded
/// where it has directions.
struct ConvexBody {
    std::vector<glm::dvec3> points, directions;
};

/// The pyramid between a camera's eye and the rectangle that its image has at a depth. Not bounded at infinite depth.
class ViewPyramid {
public:
    ViewPyramid(const Camera& camera, double aspect, double depth);

    [[nodiscard]] const ConvexBody& body() const { return body_; }
    [[nodiscard]] const std::array<glm::dvec3, 5>& normals() const { return normals_; } // of its faces

private:
    ConvexBody body_;
    std::array<glm::dvec3, 5> normals_;
};

/// A convex body around the shadow volume of everything in a box: the box and what it hides from some point of the light.
class VolumeBounds {
public:
    /// `box` lies in object space. `lights` are homogeneous positions in the world, which the light lies between.
    VolumeBounds(const Bounds& box, const glm::dmat4& world, std::span<const glm::dvec4> lights);

    /// Whether some point of the body may lie in the pyramid. False is certain, and by more than 32-bit positions round;
    /// true may be wrong near edges of both.
    [[nodiscard]] bool mayMeet(const ViewPyramid& pyramid) const;

private:
    ConvexBody body_;
    std::vector<glm::dvec3> normals_; // of all planes that may bound it
};

} // namespace shadowbench::techniques
