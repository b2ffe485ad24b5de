// The rays of a precomputation: for every point of the surfaces, which directions are blocked.
#pragma once

#include "techniques/environment/cube_map.h"
#include "techniques/environment/surface_points.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// Is told of a point, by its number, which of the directions are blocked (1) and which are not (0). Called from several
/// threads at once, once for each point.
using PointVisit = std::function<void(std::size_t point, std::span<const std::uint8_t> blocked)>;

/// Traces rays from all points that lie outside of all closed bodies. Returns for each point which one's transfer is its
/// own: a point inside takes that of the nearest point of its patch that is outside, if there is one, since pixels that
/// interpolate between the two see the latter's side. A point inside for which there is none is traced, too.
std::vector<std::uint32_t> tracePoints(const SurfacePoints& points, const Snapshot& snapshot,
                                       std::span<const DirectionSample> directions, const PointVisit& visit);

} // namespace shadowbench::techniques
