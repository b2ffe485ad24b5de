// Accuracy and stability as pure functions on images (METRICS.md). V is a technique's visibility, V* the truth's.
#pragma once

#include "groundtruth/reference.h"
#include "harness/records/record.h"
#include "harness/scene/image.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace shadowbench::metrics {

/// What the rasteriser drew at each pixel (read back from the G-buffer).
struct Drawn {
    Image<std::uint32_t> id;
    Image<glm::vec3> position;
};

/// The receiver mask M: the truth's receivers whose primary hit the rasteriser agrees on.
struct Mask {
    Image<std::uint8_t> scored;   // 1 in M
    double primaryMismatch = 0;   // share of all pixels whose primary hits disagree
    std::size_t count = 0;        // pixels in M
};
Mask receiverMask(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye);

/// Hard labels: V is rounded. Fills mismatch, mismatchOffEdge, falseShadow, leak, edgeError, primaryMismatch.
Accuracy hardAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Graded visibility: fills rmse, mae, psnr, bad30, bad8, ssim, penumbraRmse, penumbraWidthError, umbraLeak, unresolved,
/// primaryMismatch; what has no pixel to be measured on stays absent.
Accuracy softAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Share of M where abs(a − b) exceeds `threshold`.
double shareAbove(const Image<float>& a, const Image<float>& b, const Mask& mask, double threshold);
double mismatch(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);
double rmse(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// One rendered frame with its truth.
struct FrameResult {
    const Image<float>* v;
    const groundtruth::Reference* truth;
    const Mask* mask;
};

/// Where each pixel of `now` was in the previous frame, by exact reprojection of the truth's primary hits (moving placements by
/// their own motion): image position in pixels, NaN where it left the image or was disoccluded.
Image<glm::vec2> warp(const Snapshot& now, glm::ivec2 size, const groundtruth::Reference& truth, const groundtruth::Reference& before);

/// Per-pixel flicker excess abs((V_t − warp V_{t−1}) − (V*_t − warp V*_{t−1})), appended to `samples` for every pixel in both masks.
void flickerSamples(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp, std::vector<float>& samples);
Flicker flicker(std::vector<float> samples);

/// Reprojected pixels whose class (lit or not) changed while the truth's did not, and how many were compared.
struct Flips {
    std::size_t flipped = 0, compared = 0;
};
Flips flips(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp);

/// First frame from which the error stays ≤ 1.05 × its steady state (the mean of the last tenth).
int convergence(const std::vector<double>& errorByFrame);

}  // namespace shadowbench::metrics
