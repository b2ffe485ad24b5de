// Fitting and warping of light space perspective shadow maps (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <glm/vec4.hpp>
#include <span>

namespace shadowbench::techniques {

/// Light space perspective shadow map (Wimmer, Scherzer, Purgathofer 2004; Scherzer 2.2.2) of a hard light: light space
/// turned so that the view direction lies along y, then warped by a perspective along y whose near distance n spreads the
/// error evenly over the depth range (`lispsmNear`), then focused on what `camera` sees (the snapshot's, or a slice of its
/// depth range) within the half-spaces of `within`, as `fitFocused` does. Falls back to the focused, unwarped map where the
/// view direction is parallel to the light (duelling frusta).
LightView fitLispsm(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                    std::span<const glm::dvec4> within = {});

/// n_opt for a light-space depth range `d` along the view axis whose ends lie at eye depths z0 < z1: d / (√(z1/z0) − 1),
/// which is (z0 + √(z0·z1)) / sin γ for a directional light. Infinity where z1 ≤ z0 or z0 ≤ 0: no warp.
double lispsmNear(double d, double z0, double z1);

} // namespace shadowbench::techniques
