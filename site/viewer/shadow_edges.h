// Where shadow edges run in the image, as line segments.
#pragma once

#include "harness/cells/kept_images.h"

#include <vector>

namespace shadowbench::site {

/// x₀, y₀, x₁, y₁ of each segment, in pixels from the upper left corner of the image (a pixel's centre is at ½). Where the
/// truth has distances to the nearest edge, the edge runs where the distance, signed by the label, is 0 between the centres
/// of 2 × 2 receiver pixels of one surface: exact for straight edges. Elsewhere, under area lights and skies, where V* is ½.
std::vector<float> shadowEdges(const KeptTruth& truth);

/// Whether the truth has such distances.
bool hasExactEdges(const KeptTruth& truth);

} // namespace shadowbench::site
