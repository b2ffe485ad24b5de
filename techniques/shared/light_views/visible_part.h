// The part of the scene that the camera sees: what a shadow map has to hold (Scherzer Fig. 2.5; no GL).
#pragma once

#include "scene/snapshot.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Corners of the part of `box` that the camera sees: the box clipped by the view frustum (Scherzer Fig. 2.5, S ∩ V) and by
/// further half-spaces dot(plane, (p, 1)) ≥ 0.
std::vector<glm::dvec3> visiblePart(const Bounds& box, const Camera& camera, double aspect,
                                    std::span<const glm::dvec4> halfSpaces = {});

/// Half-spaces dot(plane, (p, 1)) ≥ 0 whose intersection is the frustum of a projection: left, right, bottom, top, near,
/// far.
std::array<glm::dvec4, 6> frustumPlanes(const glm::dmat4& clipFromWorld);

} // namespace shadowbench::techniques
