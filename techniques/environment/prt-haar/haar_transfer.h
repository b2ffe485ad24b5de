// Precomputed transfer in Haar wavelets on a cube map.
#pragma once

#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"

#include <cstddef>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// All coefficients of each point's transfer, ∫ V(s) max(n · s, 0) ds over each texel of a cube map of side × side,
/// transformed (techniques/environment/haar.h); then the same without V of all patches. cubeTexels(side) numbers each, one
/// vector after the other. `directions` are those of cubeSamples(side, …).
std::vector<float> haarTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                std::span<const DirectionSample> directions, int side);

/// The `chosen` coefficients of vectors of `size` numbers, one coefficient of all vectors after the other.
std::vector<float> chosenCoefficients(std::span<const float> vectors, std::size_t size, std::span<const std::size_t> chosen);

} // namespace shadowbench::techniques
