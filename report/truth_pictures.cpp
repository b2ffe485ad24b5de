#include "report/truth_figures.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::report {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;

glm::vec3 colourOf(Surface surface) {
    switch (surface) {
    case Surface::Background:
        return {0.2F, 0.25F, 0.34F};
    case Surface::FacesAway:
        return {0.34F, 0.25F, 0.2F};
    case Surface::Receiver:
    case Surface::OnEdge:
        break;
    }
    return {1, 0.45F, 0};
}

/// `grey(i)` in [0, 1] on receivers.
template <typename Grey>
Image<glm::vec3> picture(const Reference& reference, const Grey& grey) {
    Image<glm::vec3> result(reference.surface.width(), reference.surface.height());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = reference.surface[i] == Surface::Receiver ? glm::vec3(static_cast<float>(grey(i)))
                                                              : colourOf(reference.surface[i]);
    return result;
}

} // namespace

TruthNumbers truthNumbers(const Reference& reference) {
    TruthNumbers numbers;
    std::vector<float> sigmas;
    for (std::size_t i = 0; i < reference.surface.size(); ++i) {
        numbers.onEdge += reference.surface[i] == Surface::OnEdge;
        if (reference.surface[i] != Surface::Receiver) continue;
        const float visible = reference.visibility[i];
        ++numbers.receivers;
        numbers.shadowed += visible <= 0;
        numbers.penumbra += visible > 0 && visible < 1;
        numbers.edgePixels += reference.edgeDistance[i] <= 0.5F;
        if (reference.sigma[i] > 0) sigmas.push_back(reference.sigma[i]);
    }
    if (sigmas.empty()) return numbers;
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::ranges::nth_element(sigmas, middle);
    numbers.sigmaMedian = *middle;
    numbers.sigmaLargest = *std::ranges::max_element(sigmas);
    return numbers;
}

Image<glm::vec3> visibilityPicture(const Reference& reference) {
    return picture(reference, [&](std::size_t i) { return reference.visibility[i]; });
}

Image<glm::vec3> sigmaPicture(const Reference& reference, double largest) {
    return picture(reference, [&](std::size_t i) { return largest > 0 ? reference.sigma[i] / largest : 0; });
}

Image<glm::vec3> edgeDistancePicture(const Reference& reference) {
    return picture(reference, [&](std::size_t i) { return std::min(reference.edgeDistance[i] / farthestEdge, 1.0); });
}

} // namespace shadowbench::report
