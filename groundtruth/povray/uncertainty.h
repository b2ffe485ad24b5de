// How far a sampled visible fraction may be from the true one, measured on the render itself.
#pragma once

#include "groundtruth/povray/povray.h"

namespace shadowbench::groundtruth {

/// Standard uncertainty per pixel of PovRayImage::visible, whose light samples were `samples`.
///
/// The two halves of the sample set are low-discrepancy sets of their own (lightSample), rendered at the same cost in two
/// channels. Were their errors independent, half of their difference would have the standard deviation of their mean; the
/// whole set fills the gaps that each half leaves, so it errs less and this errs on the careful side. One pixel's difference
/// is a single draw: its square is averaged over the unresolved pixels of the same surface in the 5 × 5 window around it. To
/// that is added the variance of rounding to a whole number of samples, 1/(12 N²). A pixel is resolved, and its uncertainty
/// 0, if it and all its eight neighbours on the same surface (equal `id`) see the whole light, or all see none of it.
/// Background (id 0): 0.
Image<float> samplingUncertainty(const PovRayImage& image, const Image<std::uint32_t>& id, int samples);

} // namespace shadowbench::groundtruth
