// Environment light in spherical harmonics (scene/spherical_harmonics.h), and the closed forms that it needs.
#pragma once

#include "scene/sky.h"

#include <array>
#include <glm/vec3.hpp>

namespace shadowbench::techniques {

inline constexpr int shBands = 5;
inline constexpr int shCount = shBands * shBands; // the course's 25

/// Coefficients of the first five bands; that of degree l and order m is number l (l + 1) + m.
using ShVector = std::array<double, shCount>;

/// The basis functions in a unit direction.
ShVector shBasis(const glm::dvec3& direction);

/// What convolution with max(cos θ, 0) multiplies band `l` ≥ 0 by (Ramamoorthi and Hanrahan 2001, eq. 8): π, 2π/3, π/4, 0,
/// −π/24, …
double clampedCosine(int l);

/// The transfer of a point that sees all of the sky, ∫ max(normal · s, 0) y(s) ds: band l of y(normal), times
/// clampedCosine(l).
ShVector unshadowedTransfer(const glm::dvec3& normal);

/// A sun: zonal harmonics about its axis in closed form, turned into its direction.
ShVector harmonicLight(const Sun& sun);

/// All of the light, ∫ L(s) y(s) ds.
ShVector harmonicLight(const EnvironmentLight& light);

} // namespace shadowbench::techniques
