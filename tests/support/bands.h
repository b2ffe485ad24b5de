// What is left of a filter's error along a straight edge: bands run along it, noise does not.
#pragma once

#include "tests/support/filtered_scenes.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <vector>

namespace shadowbench {

/// Root mean squares over a penumbra under an edge parallel to z: of the mean error at the same x (what repeats along the
/// edge, bands), and of the errors about that mean (noise); and the greatest of those means.
struct BandsAndNoise {
    double bands = 0, noise = 0, worstMean = 0;
};

/// Of what `visibility − ramp(t)` leaves, with t from −1 to 1 over the points between `middle − reach` and `middle + reach`,
/// falling along x; in `bins` of t, each with 60 points or more.
inline BandsAndNoise bandsAndNoise(const std::vector<GroundPoint>& points, double middle, double reach,
                                   const std::function<double(double)>& ramp, int bins) {
    struct Bin {
        double sum = 0, squares = 0, count = 0;
    };
    std::map<int, Bin> errors;
    for (const GroundPoint& point : points) {
        const double t = (middle - point.at.x) / reach;
        if (std::abs(t) >= 1) continue;
        const double error = point.visibility - ramp(t);
        Bin& bin = errors[static_cast<int>(std::floor(0.5 * (t + 1) * bins))];
        bin.sum += error;
        bin.squares += error * error;
        ++bin.count;
    }
    EXPECT_EQ(errors.size(), static_cast<std::size_t>(bins));
    BandsAndNoise result;
    double bands = 0, noise = 0, count = 0;
    for (const auto& [index, bin] : errors) {
        EXPECT_GE(bin.count, 60) << "bin " << index;
        const double mean = bin.sum / bin.count;
        bands += bin.count * mean * mean;
        noise += bin.squares - bin.count * mean * mean;
        count += bin.count;
        result.worstMean = std::max(result.worstMean, std::abs(mean));
    }
    result.bands = std::sqrt(bands / count);
    result.noise = std::sqrt(noise / count);
    return result;
}

} // namespace shadowbench
