// Haar wavelets on the faces of a cube map (techniques/environment/cube_map.h): two-dimensional, orthonormal, each face by
// itself.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Replaces the texels by their coefficients: of each face, number 0 belongs to its mean, and row and column of another tell
/// its scale and place. `side`: a power of two.
void haarTransform(std::span<double> cubeMap, int side);

/// Replaces the coefficients by the texels that they are of.
void inverseHaarTransform(std::span<double> cubeMap, int side);

/// Texels that the basis function of coefficient `index` spans.
std::size_t haarSupport(std::size_t index, int side);

/// The `count` coefficients of a light that matter most for what it lights, by the area-weighted magnitude of Ng,
/// Ramamoorthi and Hanrahan (2003): the function's greatest value times the texels that it spans. In falling order.
std::vector<std::size_t> largestCoefficients(std::span<const double> coefficients, int side, std::size_t count);

} // namespace shadowbench::techniques
