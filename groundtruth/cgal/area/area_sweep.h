// Areas under winding numbers, in double precision: the fast form's sum.
//
// Between two neighbouring events (ends and crossings of edges) every boundary is straight, and what is visible of a row is
// a sum of gaps between edges: Green's theorem, one trapezoid a gap. A sum over whole boundary pieces would need to know
// which side of each piece is visible, and one wrong answer (edges that coincide, or meet in one point) costs as much as the
// piece is long. Here every answer is a comparison of places along the row; a wrong one exchanges edges that are as near as
// the rounding, and costs no more than the sliver between them. So the sum is stable whatever touches or coincides, its
// error is bounded by the errors of the edges, and it is fast enough: k edges across n rows cost O(n k + crossings).
#pragma once

#include "groundtruth/cgal/area/area_shape.h"
#include "groundtruth/cgal/area/area_view.h"

namespace shadowbench::groundtruth::area {

/// With a certain bound of the error of every figure, and the part of it that the errors of the edges bring.
struct SweptAreas {
    LightAreas areas;
    double error, edgeError;
};

/// Hidden is where the winding number of `edges` (which lie in the light's window) is positive.
SweptAreas sweepAreas(const std::vector<CoverEdge>& edges, const LightShape& shape);

/// The same for parts of the line [−½, ½]: the visible length.
struct VisibleLength {
    double visible, error, edgeError;
};
VisibleLength visibleLength(std::vector<CoverInterval> hidden);

} // namespace shadowbench::groundtruth::area
