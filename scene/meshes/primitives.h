// Built-in meshes. Everything but `plane` is closed. Sizes in metres; the origin is the centre unless said otherwise.
#pragma once

#include "scene/mesh.h"

#include <cstdint>

namespace shadowbench {

/// Square in y = 0, facing +y, side 2·half. Open.
Mesh plane(double half);

Mesh box(const glm::dvec3& size);

/// Geodesic sphere: each face of an icosahedron cut into n² triangles, n ≥ 1 such that 20 n² is nearest to `triangles`
/// (within 10 % from 2,000 up).
Mesh sphere(double radius, int triangles);

/// Upright cylinder standing on y = 0.
Mesh column(double radius, double height, int sides);

/// A closed, bumpy, star-shaped mesh: the sphere displaced along its radii by smooth seeded noise of at most ±`bump` <
/// `radius` metres; triangles as for `sphere`.
Mesh bumpy(double radius, double bump, int triangles, std::uint32_t seed);

} // namespace shadowbench
