// What one pixel sees as convex polygons, and how much of it is lit: the square is cut into strips between all corners and
// crossings, within which lengths along horizontal lines change linearly.
#pragma once

#include "groundtruth/cgal/hard/convex_polygon.h"

#include <vector>

namespace shadowbench::groundtruth::hard {

/// The part of a triangle that lies in a pixel's square, hidden by others or not.
struct Patch {
    ImagePolygon outline;
    glm::dvec3 inverseDepth{0};        // 1 / depth at image position (x, y) is its product with (x, y, 1)
    bool counts = false;               // it faces the light and is of the surface in question
    bool shadowed = false;             // wholly
    std::vector<ImagePolygon> shadows; // on its plane, as far as the square holds them

    [[nodiscard]] double nearness(double x, double y) const {
        return inverseDepth.x * x + inverseDepth.y * y + inverseDepth.z;
    }
};

/// Shares of a pixel's square.
struct AreaShares {
    double seen = 0;  // where a triangle is seen that counts: of the surface in question, facing the light; at least,
                      // if all of it is lit or all in shadow
    double lit = 0;   // and is lit
    double sigma = 0; // standard uncertainty of lit / seen; 0 where exact
};

/// Of `patches` the nearest counts at every point. Exact (to rounding) unless there are more than some hundred edges or
/// patches cross each other; then from so many lines that σ ≤ 0.01, estimated from how much neighbouring lines differ. Of
/// some hundred edges or more, lines that agree on all or nothing include the one through the square's centre.
AreaShares shares(const std::vector<Patch>& patches, const ImageRectangle& square);

} // namespace shadowbench::groundtruth::hard
