// How far a sampled visible fraction may be from the true one, estimated pixel by pixel from the render itself. Only the
// relative sizes matter: a certificate (groundtruth/certify/certificate.h) measures the error over all pixels and scales
// them.
#pragma once

#include "groundtruth/povray/povray.h"

namespace shadowbench::groundtruth::povray {

/// 1 where the light is not resolved: the pixel, or one of its eight neighbours on the same surface (equal `id`), sees a
/// part of the light, or they differ. 0 where all see the whole light or all see none of it, and on the background (id 0).
Image<std::uint8_t> unresolvedPixels(const Image<float>& visible, const Image<std::uint32_t>& id);

/// Standard uncertainty per pixel of Render::visible, whose light samples were `samples`.
///
/// The parts of the sample set are low-discrepancy sets of their own (lightSample), rendered at no extra cost in separate
/// channels, and their differences show how far such sets err. Were the errors of the two halves independent, half of their
/// difference d would have the standard deviation of their mean; the whole set fills the gaps that each half leaves, so it
/// errs less. But one half can mirror the other (a disk's angles a and −a: edges along its axis see no difference), so the
/// same is asked of the quarters of the first half, with difference e: e/2 is their mean's, and √2 less that of twice as
/// many samples. One pixel's differences are single draws: their squares are averaged over the unresolved pixels of the same
/// surface in the 5 × 5 window around it, and the larger of ⟨d²⟩/4 and ⟨e²⟩/8 counts. To it is added the variance of
/// rounding to a whole number of samples, 1/(12 N²).
///
/// 0 where the light is resolved (unresolvedPixels).
Image<float> samplingUncertainty(const Render& image, const Image<std::uint32_t>& id, int samples);

} // namespace shadowbench::groundtruth::povray
