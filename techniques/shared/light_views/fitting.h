// What the fits of light frusta share: boxes of points in light space, and matrices that make a box the unit cube (no GL).
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

namespace shadowbench::techniques {

/// Axis-aligned box of points in some light space.
struct Extent {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p);
};

/// x, y, z over w.
glm::dvec3 divided(const glm::dvec4& h);

/// Box of the points after the projective map `transform`.
Extent extentOf(const glm::dmat4& transform, const std::vector<glm::dvec3>& points);

/// Maps `extent` to [−1, 1]³, leaving `margin` (a share of the side) free on every side of x and y.
glm::dmat4 fitMatrix(const Extent& extent, double margin);

} // namespace shadowbench::techniques
