// Accuracy and stability as pure functions on images. V is a technique's visibility, V* the truth's, M the receiver mask.
//
// All images of one call have the same size. Labels are round(V): V ≥ 0.5 is lit. Sums run in double over rows from the top
// left, so a score is the same on every machine. What has no pixel to be measured on is absent; nothing here returns NaN. A
// technique that wrote a non-finite V inside M, or images of different sizes, throw InternalError.
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"
#include "harness/metrics/scores.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace shadowbench::metrics {

/// What the rasteriser drew at each pixel (read back from the G-buffer).
struct Drawn {
    Image<std::uint32_t> id;
    Image<glm::vec3> position;
};

/// The receiver mask M: the truth's receivers whose primary hit the rasteriser agrees on.
struct Mask {
    Image<std::uint8_t> scored; // 1 in M
    double primaryMismatch = 0; // share of all pixels whose primary hits disagree
    std::size_t count = 0;      // pixels in M
};

/// Primary hits agree when the surface ids are equal and, unless both are background, the distances from `eye` differ by at
/// most 0.2 % plus 0.1 mm (what 32-bit positions and a grazing view cost).
Mask receiverMask(const groundtruth::Reference& truth, const Drawn& drawn, const glm::dvec3& eye);

/// Hard labels: V is rounded. Fills mismatch, mismatchOffEdge (pixels more than ½ px from the exact edge), falseShadow
/// (share of lit pixels called shadowed), leak (share of shadowed pixels called lit), edgeError, primaryMismatch.
Accuracy hardAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Distance in pixels from the technique's shadow edge to the exact one; absent if either has no edge inside M.
///
/// An edge is sampled where two pixels of M, side by side or one above the other on the same surface, have different labels.
/// The technique's point p lies where V, linear between the two centres, is ½: halfway for hard labels. The truth's point
/// lies where its signed distance field is 0, halfway if the truth states no distance. Where V is hard everywhere the
/// truth's points are put halfway too, so that an image with the truth's labels has no error. With q the truth's point
/// nearest to p, the displacement of p is d(p) − d(q), where d is the exact distance to the edge, positive on the lit side,
/// linear between the two pixels; where the truth states no distance it is |p − q|, positive where V* is lit. `mean`, `p95`
/// and `signedMean` are over the displacements; `hausdorff` also counts the distance of every q to its nearest p.
std::optional<EdgeError> edgeError(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Graded visibility: fills rmse, mae, psnr (absent for equal images), bad30, bad8, ssim, penumbraRmse, penumbraWidthError,
/// umbraLeak, unresolved (absent for an exact truth), primaryMismatch.
/// Neighbourhoods of 2 px are 5 × 5 squares; {V* = 0} is eroded by everything outside it, the image's border too.
Accuracy softAccuracy(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Structural similarity (Wang et al. 2004: 11 × 11 Gaussian, σ 1.5 px, K 0.01 and 0.03, range 1), mean over M. Pixels
/// outside M have weight 0 in every window and the other weights are scaled to sum to 1.
std::optional<double> ssim(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Mean of |w − w*| / w* over the points where V* crosses ½ (found as for edgeError). w is the length, along the line
/// through the point in the direction of V*'s image gradient, on which 0.1 < V < 0.9, in bilinear samples ¼ px apart. The
/// line runs as far as V* takes to leave (0.1, 0.9) and as much again on each side (4 px at least), so an excess over 2 is
/// cut off; a line that leaves its surface or M before V* has left (0.1, 0.9) is not measured.
std::optional<double> penumbraWidthError(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Share of M where abs(a − b) exceeds `threshold`. This and the next two throw BadInput when M is empty.
double shareAbove(const Image<float>& a, const Image<float>& b, const Mask& mask, double threshold);
double mismatch(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);
double rmse(const Image<float>& v, const groundtruth::Reference& truth, const Mask& mask);

/// Where a world point lies in a technique's map, in texels; nothing if it lies in none.
using MapPoint = std::function<std::optional<glm::dvec2>(const glm::dvec3&)>;

/// The projected-texel-to-pixel ratio: perspective and projection aliasing in one number (Scherzer 2.2.2, Fig. 2.9; course,
/// "Perspective Shadow Maps"). With J the Jacobian from image position to texels along the plane through a receiver pixel's
/// world position at right angles to its normal, the pixel's ratio is 1 over the smallest singular value of J: the pixels
/// that one texel covers where it is stretched most. Above 1 the map is undersampled. J is taken over 1/1024 pixel on the
/// side of the pixel's centre where the map changes less, so that a border between two maps does not count. Pixels of M in
/// no map, or edge-on to eye or light, are not `mapped`; absent if none is.
std::optional<Aliasing> aliasing(const Camera& camera, const Image<glm::vec3>& positions, const Image<glm::vec3>& normals,
                                 const Mask& mask, const MapPoint& mapPoint);

/// One rendered frame with its truth.
struct FrameResult {
    const Image<float>* v;
    const groundtruth::Reference* truth;
    const Mask* mask;
};

/// Where each pixel of `now` was in the previous frame, by exact reprojection of the truth's primary hits (moving placements
/// by their own motion): image position in pixels, NaN where it left the image or was disoccluded, that is where none of the
/// 2 × 2 pixels of `before` around it shows the same surface at the same distance from the eye within 0.5 %.
Image<glm::vec2> warp(const Snapshot& now, glm::ivec2 size, const groundtruth::Reference& truth,
                      const groundtruth::Reference& before);

/// Per-pixel flicker excess abs((V_t − warp V_{t−1}) − (V*_t − warp V*_{t−1})), appended to `samples` for every pixel in
/// both masks. The previous frame is read bilinearly where all four pixels are in its mask on the same surface, else at the
/// nearest pixel if that one is, else the pixel is left out.
void flickerSamples(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp,
                    std::vector<float>& samples);
std::optional<Flicker> flicker(std::vector<float> samples);

/// Reprojected pixels (nearest) whose class, lit or not, changed while the truth's did not, and how many were compared.
struct Flips {
    std::size_t flipped = 0, compared = 0;
};
Flips flips(const FrameResult& now, const FrameResult& before, const Image<glm::vec2>& warp);

/// Squares of V − V*, to be summed over pixels and frames.
struct SquareSum {
    double sum = 0;
    std::size_t count = 0;
    [[nodiscard]] std::optional<double> root() const; // of the mean; nothing over nothing
};

/// Error while things move, over M of all frames, and over those pixels of it that the frame before did not show.
struct MovingError {
    SquareSum all, disoccluded;
};
void addMovingError(const FrameResult& now, const Image<glm::vec2>& warp, MovingError& error);

/// Number of the first frame, counted from 1, from which the error stays ≤ 1.05 × its steady state, the mean of the last
/// tenth of the frames (at least one). Absent without frames and for an error still restless at the end.
std::optional<int> convergence(const std::vector<double>& errorByFrame);

} // namespace shadowbench::metrics
