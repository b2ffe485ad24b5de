// What the entries of all techniques of precomputed radiance transfer have in common: they are over points of surfaces that
// stand still (techniques/environment/point_shading.h).
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/environment/surface_points.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::techniques {

/// Surfaces must stand still: what is known of them was computed before the first frame. Camera and light may move.
std::optional<std::string> movingSurfaces(const Scene& scene);

/// A technique's own parameters, and `points`.
std::vector<Parameter> withPoints(std::vector<Parameter> own, int defaultPoints);

/// A technique's own figures, and `points`, `spacing` and `rays`.
std::vector<Figure> withTransferFigures(std::vector<Figure> own);
std::map<std::string, double> withTransferFigures(std::map<std::string, double> own, const SurfacePoints& points,
                                                  std::size_t raysOfEach);

} // namespace shadowbench::techniques
