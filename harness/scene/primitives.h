// Built-in meshes. Everything but `plane` is closed. Sizes in metres; the origin is the centre unless said otherwise.
#pragma once

#include "harness/scene/mesh.h"

#include <cstdint>

namespace shadowbench {

/// Square in y = 0, facing +y, side 2·half. Open.
Mesh plane(double half);

Mesh box(const glm::dvec3& size);

/// UV-free icosphere-like sphere with at least `triangles` triangles wanted (the nearest count the construction allows).
Mesh sphere(double radius, int triangles);

/// Upright cylinder standing on y = 0.
Mesh column(double radius, double height, int sides);

/// A closed, bumpy, star-shaped mesh: a sphere displaced by smooth seeded noise; about `triangles` triangles.
Mesh bumpy(double radius, double bump, int triangles, std::uint32_t seed);

}  // namespace shadowbench
