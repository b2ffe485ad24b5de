// Rows of techniques/modern that are technique folders, over frames of a still scene.
#pragma once

#include "techniques/folder/folder_technique.h"
#include "tests/support/stages.h"

#include <filesystem>
#include <functional>
#include <string>

namespace shadowbench {

/// A row by its variant, such as "pcss-vogel:taps=16", as it stands in the tree.
inline std::unique_ptr<techniques::Technique> modernRow(const std::string& variant) {
    const std::string id = variant.substr(0, variant.find(':'));
    const std::filesystem::path folder = std::filesystem::path(SOURCE_FOLDER) / "techniques/modern" / id;
    const techniques::Entry entry = techniques::folderEntry(techniques::readTechniqueFolder(folder));
    const std::string chosen = variant.size() > id.size() ? variant.substr(id.size() + 1) : "";
    return entry.make(techniques::parseParameters(chosen, entry.parameters, entry.id));
}

/// The image after `frames` frames, from the first on.
inline Image<float> imageAfter(Stage& stage, techniques::Technique& row, int frames, std::uint32_t seed = 1) {
    for (int frame = 0; frame < frames; ++frame) stage.render(row, frame, seed);
    return stage.visibility();
}

inline Image<float> imageAfter(Stage& stage, const std::string& variant, int frames, std::uint32_t seed = 1) {
    return imageAfter(stage, *modernRow(variant), frames, seed);
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
