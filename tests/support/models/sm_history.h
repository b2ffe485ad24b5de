// What maps/sm-history/history.glsl computes (EGSR paper, section 3; Scherzer chapter 3).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace shadowbench::models {

/// Eq. 3.6: 1 − 2 · max-norm distance to the nearest texel centre; `texel` is the map position in texels. In [0, 1].
inline double confidence(glm::dvec2 texel) {
    const double dx = std::abs(texel.x - std::floor(texel.x) - 0.5);
    const double dy = std::abs(texel.y - std::floor(texel.y) - 0.5);
    return 1 - 2 * std::max(dx, dy);
}

/// Eq. 3.7 and 3.3: s(n) = w f + (1 − w) s(n−1) with w = confidence^m.
inline double smoothed(double previous, double current, double confidence, double m) {
    const double w = std::pow(confidence, m);
    return w * current + (1 - w) * previous;
}

} // namespace shadowbench::models
