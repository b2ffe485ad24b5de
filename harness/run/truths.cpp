#include "harness/run/truths.h"

namespace shadowbench {

groundtruth::Request Truths::request(Truth truth, int frame) const {
    groundtruth::Request request;
    request.snapshot = snapshot(scene_, frame);
    request.size = scene_.size;
    request.samples = frame < scene_.timeline.still ? scene_.referenceSamples : scene_.movingReferenceSamples;
    if (truth == Truth::Hard) request.snapshot.light = request.snapshot.light.centreOnly();
    return request;
}

const groundtruth::Reference& Truths::at(Truth truth, int frame, const Progress& progress) {
    const auto found = known_.find({truth, frame});
    if (found != known_.end()) return found->second;
    return known_.emplace(std::pair{truth, frame}, cache_.get(request(truth, frame), progress)).first->second;
}

std::vector<int> Truths::scoredFrames() const {
    std::vector<int> frames;
    for (int frame = scene_.timeline.still - 1; frame < scene_.timeline.frames(); ++frame) frames.push_back(frame);
    return frames;
}

} // namespace shadowbench
