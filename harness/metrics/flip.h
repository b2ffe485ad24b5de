// The difference that an eye sees between two pictures that alternate: FLIP of pictures in [0, 1] (Andersson, Nilsson,
// Akenine-Möller, Oskarsson, Åström, Fairchild: FLIP, a difference evaluator for alternating images, HPG 2020). Colours are
// linear, of sRGB's primaries; what is outside [0, 1] is clamped.
#pragma once

#include "base/image.h"

#include <glm/vec3.hpp>
#include <numbers>

namespace shadowbench::metrics {

/// The paper's display: 3840 pixels over 0.7 m, seen from 0.7 m.
inline constexpr double flipPixelsPerDegree = 0.7 * (3840 / 0.7) * std::numbers::pi / 180;

/// What is compared of a picture.
struct FlipPicture {
    Image<glm::vec3> colours;   // as seen: filtered by contrast sensitivity, CIELab with Hunt's adjustment
    Image<float> edges, points; // strength of the features of its unfiltered luminance
};
FlipPicture flipPicture(const Image<glm::vec3>& linear, double pixelsPerDegree = flipPixelsPerDegree);

/// The difference at each pixel, in [0, 1]. The same in either order. Throws InternalError for pictures of different sizes.
Image<float> flip(const FlipPicture& a, const FlipPicture& b);

/// Its mean.
double meanFlip(const FlipPicture& a, const FlipPicture& b);

} // namespace shadowbench::metrics
