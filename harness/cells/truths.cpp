#include "harness/cells/truths.h"

#include "base/error.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

constexpr Truth allTruths[] = {Truth::Hard, Truth::Soft, Truth::PixelArea};

} // namespace

std::string_view name(Truth truth) {
    switch (truth) {
    case Truth::Hard:
        return "hard";
    case Truth::Soft:
        return "soft";
    case Truth::PixelArea:
        return "pixel-area";
    }
    return "";
}

Truth truthNamed(std::string_view word) {
    for (const Truth truth : allTruths)
        if (name(truth) == word) return truth;
    throw BadInput(fmt::format("there is no truth \"{}\": the truths are hard, soft and pixel-area", word));
}

bool hasTruth(const Light& light, Truth truth) {
    return truth == Truth::Soft ? light.isArea() || light.isEnvironment() : !light.isEnvironment();
}

std::vector<Truth> truthsOf(const Light& light) {
    std::vector<Truth> truths;
    for (const Truth truth : allTruths)
        if (hasTruth(light, truth)) truths.push_back(truth);
    return truths;
}

groundtruth::Request referenceRequest(const Scene& scene, Truth truth, int frame) {
    if (!hasTruth(scene.light, truth))
        throw BadInput(
            fmt::format("scene {} has no {} truth: its light is of kind {}", scene.id, name(truth), name(scene.light.kind)));
    groundtruth::Request request;
    request.snapshot = snapshot(scene, frame);
    request.size = scene.size;
    request.samples = frame < scene.timeline.still ? scene.referenceSamples : scene.movingReferenceSamples;
    if (truth != Truth::Soft) request.snapshot.light = request.snapshot.light.centreOnly();
    request.pixelAreas = truth == Truth::PixelArea;
    return request;
}

std::vector<int> scoredFrames(const Scene& scene) {
    std::vector<int> frames;
    for (int frame = scene.timeline.still - 1; frame < scene.timeline.frames(); ++frame) frames.push_back(frame);
    return frames;
}

const groundtruth::ReferenceKey& Truths::keyOf(Truth truth, int frame) const {
    groundtruth::ReferenceKey& key = keys_[{truth, frame}];
    if (key.text.empty()) key = groundtruth::referenceKey(request(truth, frame));
    return key;
}

const groundtruth::Reference& Truths::at(Truth truth, int frame, const Progress& progress) {
    const auto found = known_.find({truth, frame});
    if (found != known_.end()) return found->second;
    groundtruth::Reference reference = groundtruth::cached(cache_, request(truth, frame), keyOf(truth, frame), progress);
    return known_.emplace(std::pair{truth, frame}, std::move(reference)).first->second;
}

} // namespace shadowbench
