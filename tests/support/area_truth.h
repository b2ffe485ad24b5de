// Techniques of area lights against the exact visible fraction.
#pragma once

#include "groundtruth/cgal/area/area.h"
#include "groundtruth/cgal/hard/exact.h"
#include "tests/support/stages.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench {

struct AreaError {
    double rms, most;
};

/// How far `v`, an image of the stage's frame, is from the exact visible fraction where both see the same surface.
inline AreaError errorOfArea(const Stage& stage, const Image<float>& v) {
    const glm::ivec2 size(v.width(), v.height());
    const groundtruth::PrimaryHits primary = groundtruth::hard::primaryHits(stage.shown(), size);
    const groundtruth::area::AreaScene truth(stage.shown());
    const metrics::Drawn drawn = stage.drawn();
    double sum = 0, most = 0;
    std::size_t count = 0, partial = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            if (primary.surface(x, y) != groundtruth::Surface::Receiver || drawn.id(x, y) != primary.id(x, y)) continue;
            const auto [low, high] = truth.fraction({x, y}, size, primary);
            const double error = std::abs(v(x, y) - 0.5 * (low + high));
            sum += error * error;
            most = std::max(most, error);
            ++count;
            partial += low > 0 && high < 1 ? 1 : 0;
        }
    EXPECT_GT(partial, 150U) << "too little penumbra to tell";
    return {std::sqrt(sum / static_cast<double>(count)), most};
}

} // namespace shadowbench
