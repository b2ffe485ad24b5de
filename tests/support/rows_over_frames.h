// Rows whose images change from frame to frame, over frames of a still scene.
#pragma once

#include "tests/support/stages.h"

#include <functional>
#include <string>

namespace shadowbench {

/// A row by its variant.
inline std::unique_ptr<techniques::Technique> rowOf(const std::string& variant) {
    const techniques::Variant parsed = techniques::parseVariant(variant);
    return parsed.entry->make(parsed.parameters);
}

/// The image after `frames` frames, from the first on.
inline Image<float> imageAfter(Stage& stage, techniques::Technique& row, int frames, std::uint32_t seed = 1) {
    for (int frame = 0; frame < frames; ++frame) stage.render(row, frame, seed);
    return stage.visibility();
}

inline Image<float> imageAfter(Stage& stage, const std::string& variant, int frames, std::uint32_t seed = 1) {
    return imageAfter(stage, *rowOf(variant), frames, seed);
}

/// The mean of the images of as many frames.
inline Image<float> meanOver(Stage& stage, techniques::Technique& row, int frames) {
    Image<float> sum;
    for (int frame = 0; frame < frames; ++frame) {
        stage.render(row, frame, 1);
        const Image<float> image = stage.visibility();
        if (frame == 0)
            sum = image;
        else
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += image[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= static_cast<float>(frames);
    return sum;
}

/// Root mean square of the difference of two images where `counts` says so of the first's pixel.
inline double rmsDifference(
    const Image<float>& a, const Image<float>& b,
    const std::function<bool(std::size_t)>& counts = [](std::size_t) { return true; }) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (counts(i)) {
            sum += (a[i] - b[i]) * (a[i] - b[i]);
            ++count;
        }
    EXPECT_GT(count, 0);
    return std::sqrt(sum / count);
}

} // namespace shadowbench
