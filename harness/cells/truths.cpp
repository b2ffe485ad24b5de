#include "harness/cells/truths.h"

#include "base/error.h"
#include "groundtruth/area_comparison.h"
#include "groundtruth/store/golden.h"

#include <fmt/format.h>

namespace shadowbench {
namespace {

constexpr Truth allTruths[] = {Truth::Hard, Truth::Soft,       Truth::PixelArea,
                               Truth::Area, Truth::Irradiance, Truth::SolidAngle};

} // namespace

std::string_view name(Truth truth) {
    switch (truth) {
    case Truth::Hard:
        return "hard";
    case Truth::Soft:
        return "soft";
    case Truth::PixelArea:
        return "pixel-area";
    case Truth::Area:
        return "area";
    case Truth::Irradiance:
        return "irradiance";
    case Truth::SolidAngle:
        return "solid-angle";
    }
    return "";
}

Truth truthNamed(std::string_view word) {
    for (const Truth truth : allTruths)
        if (name(truth) == word) return truth;
    throw BadInput(fmt::format("there is no truth \"{}\": the truths are hard, soft, pixel-area, area, irradiance and "
                               "solid-angle",
                               word));
}

bool hasTruth(const Light& light, Truth truth) {
    switch (truth) {
    case Truth::Soft:
        return light.isArea() || light.isEnvironment();
    case Truth::Area:
        return light.isArea();
    case Truth::Irradiance:
    case Truth::SolidAngle:
        return light.isArea() && light.kind != LightKind::Line;
    case Truth::Hard:
    case Truth::PixelArea:
        return !light.isEnvironment();
    }
    return false;
}

std::vector<Truth> truthsOf(const Light& light) {
    std::vector<Truth> truths;
    for (const Truth truth : {Truth::Hard, Truth::Soft, Truth::PixelArea})
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
    if (truth == Truth::Hard || truth == Truth::PixelArea) request.snapshot.light = request.snapshot.light.centreOnly();
    if (truth == Truth::Area) request.oracle = groundtruth::Oracle::Area;
    if (truth == Truth::Irradiance) request.oracle = groundtruth::Oracle::Irradiance;
    if (truth == Truth::SolidAngle) request.oracle = groundtruth::Oracle::SolidAngle;
    request.pixelAreas = truth == Truth::PixelArea;
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

const Truths::Known& Truths::known(Truth truth, int frame, const Progress& progress) {
    const auto found = known_.find({truth, frame});
    if (found != known_.end()) return found->second;
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
