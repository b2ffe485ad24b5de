// A regular set of samples on a light, one bit each: which of them an occluder hides (Schwarz and Stamminger 2007).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::techniques {

/// side² points of [−1, 1]², row by row, for a side that is a power of two from 2 to 16: one in each cell of a grid, and no
/// two with the same x or the same y. Those of a row lie at equal distances on a line that rises by one row from end to end,
/// so that a convex shape hides a run of them. The same as lightSample() of shared/sampling/light_samples.glsl.
std::vector<glm::vec2> lightSamples(int side);

/// Bits of the samples outside the unit disk, in words of 32, sample 0 in the lowest bit.
std::vector<std::uint32_t> samplesOutsideDisk(int side);

} // namespace shadowbench::techniques
