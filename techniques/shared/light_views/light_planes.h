// The image planes of a light, parts of them, and what casts into a part: for maps that are cut into tiles (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::techniques {

/// The views of a hard light that together hold the whole scene: `fitToScene` alone where it holds every bounding box,
/// otherwise the six sides of a cube around the light (`cubeViews`).
std::vector<LightView> lightPlanes(const Light& light, const Snapshot& snapshot);

/// The part of a view's map between `low` and `high`, which lie in [0, 1]²; its depths stay as they are.
LightView partOf(const LightView& view, const glm::dvec2& low, const glm::dvec2& high);

/// For each placement, in the order of `corners` (`boundingCorners`: eight a placement), false where its bounding box lies
/// wholly beside the view's map or behind the light.
std::vector<bool> castersIn(const LightView& view, const std::vector<glm::dvec3>& corners);

} // namespace shadowbench::techniques
