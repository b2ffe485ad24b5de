// Techniques of many light samples against the N-sample oracle: the truth of their own samples.
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/hard/samples.h"
#include "tests/support/stages.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace shadowbench {

/// Mean absolute difference between `v`, an image of the stage's frame, and the exact share of `lights` that each receiver
/// sees, where both see the same surface and no sample touches a border.
inline double meanErrorOfSamples(const Stage& stage, const Image<float>& v, const std::vector<glm::dvec3>& lights) {
    const glm::ivec2 size(v.width(), v.height());
    const groundtruth::PrimaryHits primary = groundtruth::hard::primaryHits(stage.shown(), size);
    const auto truth = groundtruth::hard::visibleShare(stage.shown(), size, primary, lights);
    const metrics::Drawn drawn = stage.drawn();
    double sum = 0;
    std::size_t count = 0, partial = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const bool receiver = primary.surface[i] == groundtruth::Surface::Receiver && drawn.id[i] == primary.id[i];
        if (!receiver || truth.undecided[i] > 0) continue;
        sum += std::abs(v[i] - truth.share[i]);
        ++count;
        partial += truth.share[i] > 0 && truth.share[i] < 1 ? 1 : 0;
    }
    EXPECT_GT(partial, 150U) << "too little penumbra to tell";
    return sum / static_cast<double>(count);
}

} // namespace shadowbench
