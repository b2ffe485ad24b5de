// Distance to the nearest shadow edge on a plane: where the winding number passes between zero and more.
#pragma once

#include "groundtruth/cgal/scanline.h"

namespace shadowbench::groundtruth {

/// Lowers `distance` (pixels) at the pixels of `members` to that of their centre to the nearest boundary of the union of
/// shadows, up to `edgeReach`; correct to some 1e-7 px. `winding` and `uncertain` are indexed by pixel + scanMargin; the
/// former is −1 where it is not known, the latter 1 where an edge may pass through the centre.
void lowerToEdgeDistance(const std::vector<PixelEdge>& edges, const Image<int>& winding,
                         const Image<std::uint8_t>& uncertain, const Image<std::uint8_t>& members, Image<float>& distance);

} // namespace shadowbench::groundtruth
