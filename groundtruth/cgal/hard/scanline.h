// Winding numbers of shadow edges at pixel centres by half-open scanlines along rows and columns.
#pragma once

#include "base/image.h"
#include "groundtruth/cgal/geometry/silhouette.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth::hard {

using namespace geometry;

/// An edge in pixels, clipped to the neighbourhood of the image. The true edge lies within `error` pixels. In the image (y
/// down), going right across an edge that runs down adds `covers` to the winding number.
struct PixelEdge {
    glm::dvec2 from, to;
    int covers;
    double error;
    std::uint32_t source; // index of the edge it comes from
};

/// Pixels around the image that are scanned too, so that every pixel has neighbours on all sides.
inline constexpr int scanMargin = 1;

/// Clips to scanMargin + 1 pixels around the image and to what lies below the light and before the camera; nothing if
/// nothing is left. `pixelError` is that of ShadowProjection.
std::optional<PixelEdge> toPixels(const ShadowEdge& edge, glm::ivec2 size, double pixelError, std::uint32_t source);

/// Indexed by pixel + scanMargin.
struct Winding {
    Image<int> change;             // of the winding number from the left neighbour
    Image<int> changeDown;         // of the winding number from the upper neighbour
    Image<std::uint8_t> uncertain; // 1 where an edge may pass through the centre: only exact arithmetic can tell
};
/// First and last row (pixel + scanMargin) whose centres the edge may meet; first > last if none.
std::pair<int, int> rowsNear(const PixelEdge& edge, glm::ivec2 size);

Winding scan(const std::vector<PixelEdge>& edges, glm::ivec2 size);

} // namespace shadowbench::groundtruth::hard
