// What the fits of light frusta share: boxes of points in light space, and matrices that map a box to the unit cube (no GL).
#pragma once

#include "scene/mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace shadowbench::techniques {

/// x, y, z over w.
glm::dvec3 divided(const glm::dvec4& h);

/// The part of a convex polygon where dot(plane, (p, 1)) ≥ 0; new corners are also appended to `cutPoints`.
std::vector<glm::dvec3> cut(const std::vector<glm::dvec3>& polygon, const glm::dvec4& plane,
                            std::vector<glm::dvec3>* cutPoints = nullptr);

/// Box of the points after the projective map `transform`.
Bounds boundsOf(const glm::dmat4& transform, const std::vector<glm::dvec3>& points);

/// Maps `box` to [−1, 1]³, leaving `margin` (a share of the side) free on every side of x and y.
glm::dmat4 fitMatrix(const Bounds& box, double margin);

} // namespace shadowbench::techniques
