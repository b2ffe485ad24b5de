// What a render of a scene may err by: the errors, at the points of a certificate, of renders with other sample sets of the
// same kind. All pixels share one sample set, so their errors are correlated and no formula for independent ones holds;
// other sets have the same correlation.
#pragma once

#include "groundtruth/cgal/area/area_points.h"

#include <vector>

namespace shadowbench::groundtruth {

/// Of a render's errors over the penumbra points: quantiles of those of honest renders, one in 100,000 of which exceeds
/// each.
struct HonestBounds {
    double bias = 0; // largest absolute mean error
    double rms = 0;  // largest rms error
    double fall = 0; // largest quotient of the rms error of all samples and that of the first quarter
};

/// Renders that nobody makes: exact visibility (groundtruth/cgal/area/area_points.h) of other scrambled sets.
class HonestRenders {
public:
    /// Of `samples` points each, on a light of that kind; `set` is that of the render to be judged, and none of theirs.
    HonestRenders(LightKind kind, int samples, std::uint32_t set);

    /// The set of the render to be judged, then the first quarter and the rest of each other one.
    [[nodiscard]] const area::LightPoints& points() const { return points_; }

    /// A point in the penumbra with its exact fraction; `visible` of points().
    void add(double fraction, const std::vector<int>& visible);

    /// Of the points so far. One set's bias is taken for normally distributed, rms and fall for log-normally; the quantiles
    /// are those of a further draw from as many.
    [[nodiscard]] HonestBounds bounds() const;

private:
    struct Sums {
        double error = 0, square = 0, squareOfQuarter = 0;
    };
    int samples_;
    area::LightPoints points_;
    std::vector<Sums> sums_; // by set
    int added_ = 0;
};

} // namespace shadowbench::groundtruth
