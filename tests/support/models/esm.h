// What filtered/esm/exponential.glsl computes (Annen et al. 2008).
#pragma once

#include <algorithm>
#include <cmath>

namespace shadowbench::models {

/// The test of a receiver at `depth` against the filtered mean of exp(c z): the mean of exp(−c (depth − z)), 1 at most.
inline double exponentialTest(double depth, double meanExponential, double c) {
    return std::min(std::exp(-c * depth) * meanExponential, 1.0);
}

/// How far before a receiver a single occluder has to be for its shadow to be at most `visibility` bright: the distance at
/// which the test is that.
inline double exponentialReach(double visibility, double c) { return -std::log(visibility) / c; }

} // namespace shadowbench::models
