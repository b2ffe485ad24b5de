// Focusing of shadow maps on what the camera sees (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

namespace shadowbench::techniques {

/// The frustum of a hard light fitted to B = L ∩ S ∩ V (Brabec, Annen, Seidel 2002; Scherzer Fig. 2.5): what `camera` (the
/// snapshot's, or a slice of its depth range) sees of the scene's bounding box, within the frustum that `fitToScene` gives
/// the light. The whole scene where B is empty.
LightView fitFocused(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect);

} // namespace shadowbench::techniques
