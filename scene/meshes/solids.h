// Closed solids that the procedural models are put together from.
#pragma once

#include "scene/mesh.h"

#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench {

/// Adds `part`, moved by the orientation-preserving affine map `place`, to `whole` as parts of its own: no vertex is shared.
void append(Mesh& whole, const Mesh& part, const glm::dmat4& place = glm::dmat4(1));

/// Tapered rod from `a` to `b` with a regular polygon of `sides` ≥ 3 corners as its section; radii > 0; 4·sides − 4
/// triangles.
Mesh rod(const glm::dvec3& a, const glm::dvec3& b, double radiusA, double radiusB, int sides);

/// Surface of revolution about y through `rings` (radius > 0, height), lowest first, closed by a pole at height `bottom` and
/// one at `top`: 2·sides·rings triangles.
Mesh revolved(double bottom, const std::vector<glm::dvec2>& rings, double top, int sides);

/// A tetrahedron that seen from above is a diamond: a leaf folded along its middle, from `base` to `tip`, with half its
/// width along `side` (not parallel to base–tip) and its sides raised by `rise` (> 0 in the direction side × (tip − base)).
/// 4 triangles.
Mesh foldedLeaf(const glm::dvec3& base, const glm::dvec3& tip, const glm::dvec3& side, double rise);

/// A direction for numbers in [0, 1), all directions alike.
glm::dvec3 directionOf(double s, double t);

} // namespace shadowbench
