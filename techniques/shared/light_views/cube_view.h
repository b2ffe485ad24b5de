// Views of an omnidirectional light (course, "Extensions"; no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <cstddef>

namespace shadowbench::techniques {

/// The six sides of a cube around `light`, each a square view of 90°: +x, −x, +y, −y, +z, −z. Depth reaches to the farthest
/// of `points`; near is a hundredth of it.
std::vector<LightView> cubeViews(const glm::dvec3& light, const std::vector<glm::dvec3>& points);

/// The side through which a direction from the light leaves the cube; the first one where it meets an edge. The same as
/// sideOf() of shared/maps/cube_side.glsl (compared in tests/techniques/gl/map_point_test.cpp).
std::size_t cubeSide(const glm::dvec3& direction);

} // namespace shadowbench::techniques
