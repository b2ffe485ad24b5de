// Views of an omnidirectional light (course, "Extensions"; no GL).
#pragma once

#include "techniques/maps/light_view.h"

namespace shadowbench::techniques {

/// The six sides of a cube around `light`, each a square view of 90°: +x, −x, +y, −y, +z, −z. Depth reaches to the farthest
/// of `points`; near is a hundredth of it.
std::vector<LightView> cubeViews(const glm::dvec3& light, const std::vector<glm::dvec3>& points);

} // namespace shadowbench::techniques
