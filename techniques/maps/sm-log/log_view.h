// Fitting of logarithmic perspective shadow maps (no GL).
#pragma once

#include "techniques/shared/light_views/light_view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace shadowbench::techniques {

/// A logarithmic perspective map over a hard light's plane, in which y is the distance v from the centre of the warp.
struct LogView {
    glm::dmat4 planeFromWorld{
        1}; // x and y over w; z over w is depth, −1 at the scene's nearest to the light and 1 at its farthest
    double near = 1, far = 2;    // v at the map's lower and upper rim
    double left = -1, right = 1; // x / v at its other two

    /// Where a point of the plane lies in the map, in [0, 1]² within it: x / v, and the share of log v. `at.y` > 0.
    [[nodiscard]] glm::dvec2 onMap(const glm::dvec2& at) const;
};

/// The map of what `camera` sees (Lloyd et al. 2008), along the view axis; the centre of its warp is the eye where that is
/// seen beside the light (`logNear`).
LogView fitLog(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect);

/// The least v of a range `d` along the plane's y whose ends lie at eye depths z0 < z1, with which v grows as the depth
/// does: d / (z1 / z0 − 1). No more than twenty times `d`, which is no warp to speak of.
double logNear(double d, double z0, double z1);

/// Where `world` lies in a map of `side`² texels, in texels; nothing beside the map, behind the light or before the warp.
std::optional<glm::dvec2> texelAt(const LogView& view, const glm::dvec3& world, int side);

} // namespace shadowbench::techniques
