// Techniques of many light samples against the N-sample oracle: the truth of their own samples.
#pragma once

#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/hard/samples.h"
#include "techniques/shared/sampling/light_points.h"
#include "tests/support/stages.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

namespace shadowbench {

/// What is exact but for the rasteriser: it rounds corners to 1/256 of a pixel, and of every hundred pixels a few lie on the
/// edge of a sample's shadow.
inline constexpr double rasterised = 2e-4;

inline std::vector<glm::dvec3> samplesOf(const Scene& scene, std::string_view pattern, int count, std::uint32_t seed = 1) {
    return techniques::lightPoints(scene.light, pattern, count, seed);
}

/// The slab under two plates, one below the other, and a bumpy body that hides parts of itself; a round light.
inline Scene overlapScene() {
    Scene scene = groundScene(96);
    scene.light = {LightKind::Disk, {0.4, 6, 0.2}, {0, -1, 0}, {1.3, 0, 0.2}, {-0.2, 0, 1.3}};
    scene.objects.push_back(object(box({1.6, 0.1, 1.2}), {0.13, 1.2, 0.21}, 17));
    scene.objects.push_back(object(box({1.1, 0.1, 1.9}), {-0.3, 2.1, 0.1}, 41));
    scene.objects.push_back(object(bumpy(0.7, 0.2, 300, 3), {-2.1, 0.9, 0.7}));
    return scene;
}

/// A sheet without a back over the slab under a square light, seen from above.
inline Scene openMeshScene(const Mesh& sheet) {
    Scene scene = groundScene(64);
    scene.light = {LightKind::Rectangle, {0.2, 6.1, 0.3}, {0, -1, 0}, {0.6, 0, 0}, {0, 0, 0.6}};
    scene.camera.eye = {0.9, 5.2, 1.1}; // most rays end in the directions of the light's own
    scene.camera.target = {0.5, 0, 0.6};
    scene.objects.push_back(object(sheet, {0.6, 1.5, 0.7}));
    return scene;
}

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
