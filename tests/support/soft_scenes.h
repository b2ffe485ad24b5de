// Scoring soft-shadow techniques on halfPlaneScene(): under the edge of a large plate the penumbra of a rectangle whose
// sides are parallel to the edge is a linear ramp.
#pragma once

#include "tests/support/stages.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {

/// Metres along x on that slab: lit up to the first, umbra from the last, and between them the hard shadow's edge of the
/// light's centre.
inline constexpr double litUntil = 0.025, hardEdge = 0.4, umbraFrom = 0.775;

/// A pixel that sees the top of the slab.
struct SlabPoint {
    glm::dvec3 at;
    double visibility; // the technique's
    double truth;
};

inline std::vector<SlabPoint> slabPoints(const Stage& stage, const Image<float>& v) {
    const metrics::Drawn drawn = stage.drawn();
    std::vector<SlabPoint> points;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const glm::dvec3 p = drawn.position[i];
        if (drawn.id[i] == 1 && p.y > -0.001) points.push_back({p, v[i], halfPlaneVisibility(p)});
    }
    EXPECT_GT(points.size(), 3000U);
    return points;
}

/// Root mean square of the error over the points for which `counts`.
template <typename Counts>
double rmsErrorWhere(const std::vector<SlabPoint>& points, Counts counts) {
    double sum = 0;
    std::size_t count = 0;
    for (const SlabPoint& point : points) {
        if (!counts(point)) continue;
        sum += (point.visibility - point.truth) * (point.visibility - point.truth);
        ++count;
    }
    EXPECT_GT(count, 100U);
    return std::sqrt(sum / static_cast<double>(count));
}

inline double rmsError(const std::vector<SlabPoint>& points) {
    return rmsErrorWhere(points, [](const SlabPoint&) { return true; });
}

/// Over the true penumbra, in which a hard shadow errs by ½/√3.
inline double penumbraRmsError(const std::vector<SlabPoint>& points) {
    return rmsErrorWhere(points, [](const SlabPoint& point) { return point.truth > 0 && point.truth < 1; });
}

/// Mean visibility of the points whose x lies within `reach` of `x`.
inline double visibilityAt(const std::vector<SlabPoint>& points, double x, double reach = 0.02) {
    double sum = 0;
    std::size_t count = 0;
    for (const SlabPoint& point : points)
        if (std::abs(point.at.x - x) <= reach) {
            sum += point.visibility;
            ++count;
        }
    EXPECT_GT(count, 0U) << "no pixel at x = " << x;
    return sum / static_cast<double>(count);
}

/// The range of x over which visibility lies strictly between `low` and `high`, in metres; 0 where there is no such point.
inline double widthBetween(const std::vector<SlabPoint>& points, double low, double high) {
    double from = 1e30, to = -1e30;
    for (const SlabPoint& point : points)
        if (point.visibility > low && point.visibility < high) {
            from = std::min(from, point.at.x);
            to = std::max(to, point.at.x);
        }
    return std::max(0.0, to - from);
}

} // namespace shadowbench
