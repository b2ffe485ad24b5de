// Fitting and warping of light space perspective shadow maps (no GL).
#pragma once

#include "scene/mesh.h"
#include "techniques/shared/light_views/light_view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// What warps along the view axis begin with: the plane of a hard light, turned so that the view direction lies along +y.
struct TurnedLight {
    LightView view;                    // of the whole scene
    std::vector<glm::dvec3> body = {}; // what the camera sees of the scene's box; empty: nothing of it lies before the light
    glm::dmat4 plane{1};               // from the world: x, y and depth, over w, in the proportions of the map
    Bounds box = {};                   // of the body there
    glm::dvec3 nearest{0};             // point of it that is nearest to the eye, there
    double z0 = 0, z1 = 0;             // eye depths at the ends of a line along y, as long as the box
};

TurnedLight turnedAlongView(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                            std::span<const glm::dvec4> within = {});

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
