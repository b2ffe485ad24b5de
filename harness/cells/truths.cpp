#include "harness/cells/truths.h"

#include "base/error.h"
#include "base/trace.h"
#include "groundtruth/area_comparison.h"
#include "groundtruth/store/golden.h"

#include <filesystem>
#include <fmt/format.h>

namespace shadowbench {
std::vector<Truth> truthsOf(const Light& light) {
    std::vector<Truth> truths;
    for (const Truth truth : {Truth::Hard, Truth::Soft, Truth::PixelArea})
        if (hasTruth(light, truth)) truths.push_back(truth);
    return truths;
}

groundtruth::Request referenceRequest(const Scene& scene, Truth truth, int frame) {
    groundtruth::requireTruth(fmt::format("scene {}", scene.id), scene.light, truth);
    const int samples = frame < scene.timeline.still ? scene.referenceSamples : scene.movingReferenceSamples;
    groundtruth::Request request{snapshot(scene, frame), scene.size, truth, samples};
    request.snapshot.light = request.light();
    return request;
}

std::vector<std::pair<Truth, int>> askedTruths(const Scene& scene) {
    std::vector<std::pair<Truth, int>> asked;
    for (const int frame : scoredFrames(scene))
        for (const Truth truth : truthsOf(scene.light)) asked.emplace_back(truth, frame);
    if (hasTruth(scene.light, Truth::Area)) asked.emplace_back(Truth::Area, scene.timeline.still - 1);
    return asked;
}

const groundtruth::ReferenceKey& Truths::keyOf(Truth truth, int frame) const {
    groundtruth::ReferenceKey& key = keys_[{truth, frame}];
    if (key.text.empty()) key = groundtruth::referenceKey(request(truth, frame));
    return key;
}

bool Truths::isKept(Truth truth, int frame) const {
    return std::filesystem::exists(cache_.entry(key(truth, frame), sources(truth, frame)));
}

const Truths::Known& Truths::known(Truth truth, int frame, const Progress& progress) {
    const auto found = known_.find({truth, frame});
    if (found != known_.end()) return found->second;
    const Span span(isKept(truth, frame) ? "truth fetched" : "truth computed", name(truth), scene_.id);
    Known made{groundtruth::cached(cache_, request(truth, frame), keyOf(truth, frame), progress), ""};
    made.content = contentOf(contentHashes(made.reference));
    requireGolden(golden_, key(truth, frame), made.content);
    const bool sampled = truth == Truth::Soft && scene_.light.isArea();
    if (sampled && frame == scene_.timeline.still - 1) requireNearArea(made.reference, frame, progress);
    return known_.emplace(std::pair{truth, frame}, std::move(made)).first->second;
}

void Truths::requireNearArea(const groundtruth::Reference& soft, int frame, const Progress& progress) {
    try {
        groundtruth::requireNearExact(soft, at(Truth::Area, frame, progress));
    } catch (const Inconclusive& error) {
        throw Inconclusive(fmt::format("scene {} frame {}: {}", scene_.id, frame, error.what()));
    }
}

} // namespace shadowbench
