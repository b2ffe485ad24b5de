// The truth report's figures: numbers, pictures and charts of references.
#pragma once

#include "base/image.h"
#include "report/truth_report.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace shadowbench::report {

/// Pixel counts of a reference, and its σ over the receiver pixels where it is not 0.
struct TruthNumbers {
    std::size_t receivers = 0; // labelled pixels
    std::size_t shadowed = 0, penumbra = 0;
    std::size_t onEdge = 0;     // pixels without a label: exactly on a shadow edge
    std::size_t edgePixels = 0; // receivers within half a pixel of a hard shadow edge
    double sigmaMedian = 0, sigmaLargest = 0;
};
TruthNumbers truthNumbers(const groundtruth::Reference& reference);

/// Grey as the visible fraction on receivers; other pixels in the colours of `surfaceLegend`.
Image<glm::vec3> visibilityPicture(const groundtruth::Reference& reference);

/// σ on receivers: black 0, white `largest`.
Image<glm::vec3> sigmaPicture(const groundtruth::Reference& reference, double largest);

/// Distance to the nearest hard shadow edge on receivers: black at the edge, white from `farthestEdge` pixels on.
Image<glm::vec3> edgeDistancePicture(const groundtruth::Reference& reference);
inline constexpr double farthestEdge = 8; // as far as oracles look

inline constexpr const char* surfaceLegend =
    "Blue-grey: background. Brown: faces away from the light. Orange: exactly on a shadow edge, no label.";

/// SVG: receiver pixels by distance to the nearest hard shadow edge, and by σ where there is an uncertainty.
std::string histograms(const TruthOfScene& scene);

/// SVG: seconds by scene and oracle.
std::string secondsChart(const std::vector<TruthOfScene>& scenes);

} // namespace shadowbench::report
