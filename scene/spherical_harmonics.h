// Real spherical harmonics, by which smooth functions of a direction are written as short lists of numbers.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench {

/// The bands of a list of `coefficients` numbers, its square root; 0 if that is no whole number.
int harmonicBands(std::size_t coefficients);

/// The basis functions of the first `bands` ≥ 1 bands in a unit direction, `bands`² of them: that of degree l and order m,
/// −l ≤ m ≤ l, is number l (l + 1) + m. They are orthonormal over the sphere and without the Condon–Shortley sign, the polar
/// axis is the world's +z: ½ √(1/π), then √(3/4π) (y, z, x), then √(15/4π) (xy, yz, (3z² − 1)/√12, xz, (x² − y²)/2), as
/// Ramamoorthi and Hanrahan (2001) write them.
std::vector<double> harmonics(const glm::dvec3& direction, int bands);

/// The function with these `coefficients`, a square number of them, in a unit direction.
double harmonicSum(const std::vector<double>& coefficients, const glm::dvec3& direction);

} // namespace shadowbench
