// Precomputed transfer in spherical harmonics.
#pragma once

#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"

#include <cstddef>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// The transfer vectors of all points, ∫ V(s) max(n · s, 0) y(s) ds in the first `coefficients` basis functions, then the
/// same without V of all patches: `coefficients` numbers each, one vector after the other. V is sampled in the given
/// directions; what they find blocked is taken from the closed form of the unshadowed transfer.
std::vector<float> harmonicTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                    std::span<const DirectionSample> directions, std::size_t coefficients);

} // namespace shadowbench::techniques
