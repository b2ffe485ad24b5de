// Distance to the nearest shadow edge on a plane: where the winding number passes between zero and more.
#pragma once

#include "groundtruth/cgal/hard/plane_winding.h"

namespace shadowbench::groundtruth::hard {

/// Lowers `distance` (pixels) at the pixels of `members` to that of their centre to the nearest boundary of the union of
/// shadows, up to `edgeReach`; correct to some 1e-7 px. `edges` and `winding` belong together.
void lowerToEdgeDistance(const std::vector<PixelEdge>& edges, const PlaneWinding& winding,
                         const Image<std::uint8_t>& members, int threads, Image<float>& distance);

} // namespace shadowbench::groundtruth::hard
