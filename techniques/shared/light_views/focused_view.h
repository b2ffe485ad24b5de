// Focusing of shadow maps on what the camera sees (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <glm/vec4.hpp>
#include <span>

namespace shadowbench::techniques {

/// The frustum of a hard light fitted to B = L ∩ S ∩ V (Brabec, Annen, Seidel 2002; Scherzer Fig. 2.5): what `camera` (the
/// snapshot's, or a slice of its depth range) sees of the scene's bounding box, within the frustum that `fitToScene` gives
/// the light and, if any are given, the half-spaces dot(plane, (p, 1)) ≥ 0 of `within`. The whole scene where B is empty.
LightView fitFocused(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                     std::span<const glm::dvec4> within = {});

} // namespace shadowbench::techniques
