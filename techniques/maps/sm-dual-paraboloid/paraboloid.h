// The paraboloid map of a half space around a light (Brabec, Annen, Seidel 2002; no GL).
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace shadowbench::techniques {

/// Share of a map's half width that its half space fills; the rest shows what lies just behind its rim, for texels there.
inline constexpr double paraboloidFilled = 0.95;

/// A map shows what lies behind its half space by up to this share of its distance from the light.
inline constexpr double paraboloidRim = 0.05;

/// Whether a position in the light's frame lies in no direction that the map shows. Such positions are a convex cone, so
/// that a box with all its corners there lies there.
inline bool beyondRim(const glm::dvec3& position) { return position.z + paraboloidRim * glm::length(position) < 0; }

/// From a position in the light's frame, z ≥ 0 along the map's axis, to x and y in [−1, 1] over the map and depth in [0, 1],
/// which is the distance over `far`. The same as paraboloid() of paraboloid.glsl (compared in
/// tests/techniques/gl/map_point_test.cpp).
inline glm::dvec3 paraboloid(const glm::dvec3& position, double far) {
    const double distance = glm::length(position);
    const glm::dvec3 n = position / distance;
    return {paraboloidFilled * n.x / (1 + n.z), paraboloidFilled * n.y / (1 + n.z), distance / far};
}

} // namespace shadowbench::techniques
