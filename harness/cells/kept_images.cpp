#include "harness/cells/kept_images.h"

#include "base/image_io.h"
#include "harness/cells/cell.h"
#include "harness/cells/cell_images.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

template <class T>
Image<float> asFloats(const Image<T>& image) {
    Image<float> result(image.width(), image.height());
    std::transform(image.begin(), image.end(), result.begin(), [](T value) { return static_cast<float>(value); });
    return result;
}

} // namespace

bool isFolderName(const std::string& name) {
    constexpr std::size_t longestName = 255; // of a file, in bytes
    return !name.empty() && name.front() != '.' && name.size() <= longestName && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
}

fs::path cellFolder(const fs::path& images, const std::string& scene, const std::string& variant) {
    return images / scene / fileName(variant);
}

fs::path truthFile(const fs::path& images, const std::string& scene, std::string_view truth) {
    return images / scene / fmt::format("truth-{}.exr", truth);
}

fs::path truthSequenceFile(const fs::path& images, const std::string& scene, std::string_view truth) {
    return images / scene / fmt::format("truth-{}-sequence.png", truth);
}

fs::path shadingFile(const fs::path& images, const std::string& scene) { return images / scene / "shading.exr"; }

std::vector<std::string> keptTruths(const fs::path& images, const std::string& scene) {
    std::vector<std::string> names;
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::directory_iterator(images / scene, missing)) {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() == ".exr" && stem.starts_with("truth-")) names.push_back(stem.substr(6));
    }
    std::ranges::sort(names);
    return names;
}

void keepCell(const fs::path& folder, const CellImages& images) {
    writeExr(folder / "visibility.exr", {{"V", &images.visibility()}});
    if (images.frames.size() < 2) return;
    std::vector<Image<float>> sequence;
    for (const auto& [frame, visibility] : images.frames) sequence.push_back(visibility);
    keepSequence(folder / "sequence.png", sequence);
    if (!images.flicker.empty()) keepSequence(folder / "flicker.png", images.flicker);
}

void keepTruth(const fs::path& file, const groundtruth::Reference& truth) {
    const Image<float> surface = asFloats(truth.surface);
    const Image<float> id = asFloats(truth.id); // exact up to 2²⁴ placements
    writeExr(file, {{"V", &truth.visibility},
                    {"sigma", &truth.sigma},
                    {"surface", &surface},
                    {"edge", &truth.edgeDistance},
                    {"id", &id}});
}

void keepSequence(const fs::path& file, const std::vector<Image<float>>& frames) {
    const int height = frames.front().height();
    Image<float> stacked(frames.front().width(), height * static_cast<int>(frames.size()));
    auto next = stacked.begin();
    for (const Image<float>& frame : frames) next = std::copy(frame.begin(), frame.end(), next);
    writePng(file, stacked);
}

KeptTruth readTruth(const fs::path& file) {
    return {readChannel(file, "V"), readChannel(file, "sigma"), readChannel(file, "surface"), readChannel(file, "edge"),
            readChannel(file, "id")};
}

void keepShading(const fs::path& file, const PictureShading& shading) {
    std::array<Image<float>, 3> colours;
    for (int i = 0; i < 3; ++i) {
        colours[i] = shading.direct; // of its size
        std::ranges::transform(shading.ambient, colours[i].begin(), [i](const glm::vec3& light) { return light[i]; });
    }
    writeExr(file, {{"R", &colours[0]}, {"G", &colours[1]}, {"B", &colours[2]}, {"direct", &shading.direct}});
}

std::optional<PictureShading> readShading(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return {};
    PictureShading shading{{}, readChannel(file, "direct")};
    shading.ambient = Image<glm::vec3>(shading.direct.width(), shading.direct.height());
    int colour = 0;
    for (const char* name : {"R", "G", "B"}) {
        const Image<float> light = readChannel(file, name);
        for (std::size_t i = 0; i < light.size(); ++i) shading.ambient[i][colour] = light[i];
        ++colour;
    }
    return shading;
}

} // namespace shadowbench
