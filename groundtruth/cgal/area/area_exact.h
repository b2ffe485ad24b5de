// A second, slower computation of the visible fraction, to check the fast one by: rational numbers from the receiver point
// to the area.
#pragma once

#include "groundtruth/cgal/area/area.h"
#include "groundtruth/cgal/area/area_view.h"

namespace shadowbench::groundtruth::area {

/// Shares with the fast form only the triangles that may hide something (`candidates`), the point, and the polygons that
/// enclose a disk.
VisibleFraction exactVisibleFraction(const std::vector<Triangle>& candidates, const Light& light, const SurfacePoint& point);

} // namespace shadowbench::groundtruth::area
