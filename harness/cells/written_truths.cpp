#include "harness/cells/written_truths.h"

#include "base/files.h"
#include "base/image_io.h"
#include "base/pattern.h"
#include "groundtruth/contract/reference_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

template <class T>
Image<float> numbersOf(const Image<T>& image) {
    Image<float> numbers(image.width(), image.height());
    std::transform(image.begin(), image.end(), numbers.begin(), [](T value) { return static_cast<float>(value); });
    return numbers;
}

/// Without the time that computing it took, which is another in every run.
std::string describe(SceneFrames& frames, Truth truth, int frame) {
    auto provenance = nlohmann::ordered_json::parse(groundtruth::provenanceJson(frames.truth(truth).provenance));
    provenance.erase("seconds");
    nlohmann::ordered_json json{{"scene", frames.scene().id}, {"frame", frame}, {"truth", std::string(name(truth))}};
    json.update(provenance);
    json["content"] = frames.truths().content(truth, frame);
    json["scored"] = frames.mask(truth).count;
    json["primary_mismatch"] = frames.mask(truth).primaryMismatch;
    return json.dump(2) + "\n";
}

/// Of the frame that is shown.
void writeImage(SceneFrames& frames, Truth truth, const fs::path& file) {
    const groundtruth::Reference& reference = frames.truth(truth);
    const Image<float> scored = numbersOf(frames.mask(truth).scored), surface = numbersOf(reference.surface),
                       id = numbersOf(reference.id);
    std::vector<Channel> channels{
        {"V", &reference.visibility}, {"sigma", &reference.sigma}, {"scored", &scored}, {"surface", &surface}, {"id", &id}};
    if (truth == Truth::Hard) channels.emplace_back("edge_distance", &reference.edgeDistance);
    writeExr(file, channels);
}

} // namespace

std::vector<std::pair<Truth, int>> writtenTruths(const Scene& scene) {
    std::vector<std::pair<Truth, int>> written;
    for (const Truth truth : {Truth::Hard, Truth::Soft, Truth::PixelArea, Truth::Area, Truth::Irradiance, Truth::SolidAngle})
        if (hasTruth(scene.light, truth)) written.emplace_back(truth, scene.timeline.still - 1);
    for (const int frame : scoredFrames(scene))
        if (frame >= scene.timeline.still)
            for (const Truth truth : truthsOf(scene.light)) written.emplace_back(truth, frame);
    return written;
}

std::vector<std::string> writeTruths(SceneFrames& frames, const fs::path& folder, const Progress& progress) {
    const auto written = writtenTruths(frames.scene());
    for (std::size_t i = 0; i < written.size(); ++i) {
        const auto& [truth, frame] = written[i];
        const std::string what = fmt::format("{} truth of frame {}", name(truth), frame);
        frames.truths().at(truth, frame, [&](double share, std::string_view) {
            if (progress) progress((static_cast<double>(i) + share) / static_cast<double>(written.size()), what);
        });
    }
    removeTruths(folder);
    std::vector<std::string> files;
    int shown = -1;
    for (const auto& [truth, frame] : written) {
        if (frame != shown) frames.show(frame);
        shown = frame;
        const std::string stem = fmt::format("frame-{}-{}", frame, name(truth));
        writeImage(frames, truth, folder / (stem + ".exr"));
        writeFile(folder / (stem + ".json"), describe(frames, truth, frame));
        files.push_back(stem + ".exr");
        files.push_back(stem + ".json");
    }
    return files;
}

void removeTruths(const fs::path& folder) {
    const std::string ours = "^frame-[0-9]+-(hard|soft|pixel-area|area|irradiance|solid-angle)\\.(exr|json)$";
    std::error_code missing;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
        if (!firstMatch(entry.path().filename().string(), ours).empty()) files.push_back(entry.path());
    for (const fs::path& file : files) fs::remove(file);
}

} // namespace shadowbench
