// Precomputed transfer in Haar wavelets on a cube map.
#pragma once

#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// The coefficients of a transfer vector that are stored, by ascending number; the others are taken for zero.
struct StoredTransfer {
    std::vector<std::uint16_t> numbers;
    std::vector<float> values;

    [[nodiscard]] std::size_t bytes() const {
        return numbers.size() * sizeof numbers.front() + values.size() * sizeof values.front();
    }
};

/// Each point's transfer, ∫ V(s) max(n · s, 0) ds over each texel of a cube map of side × side, transformed
/// (techniques/environment/haar.h): its coefficients of `least` and more in size. `directions` are those of
/// cubeSamples(side, …).
std::vector<StoredTransfer> haarTransfer(const SurfacePoints& points, const Snapshot& snapshot,
                                         std::span<const DirectionSample> directions, int side, double least);

/// The `chosen` coefficients of all vectors, one coefficient of all vectors after the other.
std::vector<float> chosenCoefficients(std::span<const StoredTransfer> vectors, std::span<const std::size_t> chosen);

/// The irradiance of each patch that sees all of the sky, from a light given by its `texels`.
std::vector<float> unshadowedIrradiance(std::span<const PointPatch> patches, std::span<const DirectionSample> directions,
                                        std::span<const double> texels);

} // namespace shadowbench::techniques
