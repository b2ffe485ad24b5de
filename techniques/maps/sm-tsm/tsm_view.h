// Fitting of trapezoidal shadow maps (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

namespace shadowbench::techniques {

/// Distance from the top line to the centre of projection η that puts a point at distance `focus` from the top line, of a
/// trapezoid of height `height`, on the line that leaves a share `rule` of the map on its near side (Martin, Tan 2004, the
/// "80 % rule"). Infinity where no perspective is needed: focus ≥ rule · height.
double tsmCentre(double height, double focus, double rule);

/// Trapezoidal shadow map (Martin, Tan 2004; Scherzer 2.2.2) of a hard light: what `camera` sees, as the light sees it, is
/// bounded by a trapezoid along the view axis, which a perspective in the map's plane maps to the square. The first `focus`
/// (a share of the visible depth) takes four fifths of the map. Falls back to the unwarped, focused map where the view axis
/// has no direction in the map (duelling frusta).
LightView fitTsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect, double focus);

} // namespace shadowbench::techniques
