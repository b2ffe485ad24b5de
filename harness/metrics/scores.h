// The scores: pure functions of images, frames and walks, which the table of metrics (table.h) names.
//
// V is a technique's visibility, V* the truth's, M the receiver mask. Labels are round(V): V ≥ 0.5 is lit. Sums run in
// double over rows from the top left, so a value is the same on every machine. What has no pixel to be measured on is
// absent; no function returns NaN. A technique that wrote a V inside M that is not finite, or images of different sizes,
// throw InternalError.
#pragma once

#include "harness/metrics/metric.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace shadowbench::metrics {

/// Wrong labels as shares.
struct LabelErrors {
    std::optional<double> mismatch;        // of M
    std::optional<double> unrounded;       // of M: mean abs(V − V*), which is `mismatch` where V is 0 or 1 everywhere
    std::optional<double> mismatchOffEdge; // of the pixels more than ½ px from the exact edge
    std::optional<double> falseShadow;     // lit pixels called shadowed, of the lit ones
    std::optional<double> leak;            // shadowed pixels called lit, of the shadowed ones
};
LabelErrors labelErrors(const ScoredFrame& frame);

/// The pixels that these shares are of.
struct LabelledPixels {
    double all = 0, lit = 0, shadowed = 0, offEdge = 0;
};
LabelledPixels labelledPixels(const ScoredFrame& frame);

/// Displacement in pixels of the technique's shadow edge from the exact one, both ways.
struct EdgeError {
    std::optional<double> mean, median, p95, hausdorff;
    std::optional<double> signedMean; // − shadow too small, + too large
    double missing = 0;               // share of the exact edge that the technique has nothing near
    double islands = 0;               // wrong regions away from every exact edge
};

/// Absent if the truth has no edge inside M; all but `missing` and `islands` are absent if the technique's image has none.
///
/// An edge is sampled where two pixels of M, side by side or one above the other on the same surface, have different labels.
/// The technique's point p lies where V, linear between the two centres, is ½: halfway for hard labels. The truth's point
/// lies where its signed distance field is 0, halfway if the truth states no distance. Where V is hard everywhere the
/// truth's points are put halfway too, so that an image with the truth's labels has no error.
///
/// An island (acne, a hole) is a 4-connected region of wrong pixels on one surface of which no centre lies within 2 pixels
/// of a point of the exact edge. Its outline is not measured, islands are counted. With q the truth's point nearest to p,
/// the displacement of p is d(p) − d(q), where d is the exact distance to the edge, positive on the lit side, linear between
/// the two pixels; where the truth states no distance it is |p − q|, positive where V* is lit. In the same way each q is
/// displaced to the p nearest to it, unless that is more than 8 pixels away: then the edge is missing there. `mean`,
/// `median` and `p95` are over the displacements of all p and of all q that are not missing, `signedMean` over those of all
/// p; `hausdorff` is the largest displacement of a p or distance of a q from its nearest p.
std::optional<EdgeError> edgeError(const ScoredFrame& frame);

/// Sums over M of V − V*; absent where M is empty.
struct VisibilityErrors {
    double rmse = 0, mae = 0;
    std::optional<double> psnr; // peak 1; absent for equal images
};
std::optional<VisibilityErrors> visibilityErrors(const ScoredFrame& frame);
std::optional<double> rmse(const ScoredFrame& frame);

/// Share of M where abs(V − V*) exceeds 30/255 (EGSR 2007) or 8/255.
std::optional<double> bad30(const ScoredFrame& frame);
std::optional<double> bad8(const ScoredFrame& frame);

/// Structural similarity (Wang et al. 2004: 11 × 11 Gaussian, σ 1.5 px, K 0.01 and 0.03, range 1), mean over M. Pixels
/// outside M have weight 0 in every window and the other weights are scaled to sum to 1.
std::optional<double> ssim(const ScoredFrame& frame);

/// rmse over the penumbra {0 < V* < 1}, and over the same dilated by 2 pixels (5 × 5 squares); absent for a hard truth.
struct PenumbraErrors {
    std::optional<double> within, dilated;
};
PenumbraErrors penumbraErrors(const ScoredFrame& frame);

/// Mean of |w − w*| / w* over the points where V* crosses ½ (found as for edgeError). w is the length, along the line
/// through the point in the direction of V*'s image gradient, on which 0.1 < V < 0.9, in bilinear samples ¼ px apart. The
/// line runs as far as V* takes to leave (0.1, 0.9) and as much again on each side (4 px at least), so an excess over 2 is
/// cut off; a line that leaves its surface or M before V* has left (0.1, 0.9) is not measured.
std::optional<double> penumbraWidthError(const ScoredFrame& frame);

/// Mean V over the umbra {V* = 0} eroded by 2 pixels, from the image's border too.
std::optional<double> umbraLeak(const ScoredFrame& frame);

/// How many pixels rmse, penumbraErrors (within) and umbraLeak are over.
struct GradedPixels {
    double all = 0, penumbra = 0, umbra = 0;
};
GradedPixels gradedPixels(const ScoredFrame& frame);

/// Shares of M without light, which would be stored as 0 of 255: the technique's and the truth's. Absent where there is no
/// penumbra, as in a hard truth.
struct Umbra {
    double drawn = 0, exact = 0;
};
std::optional<Umbra> umbra(const ScoredFrame& frame);

/// What an eye sees in V alone, wherever it is graded (0.02 < V < 0.98) on one surface in M: bands, as the share of the 2 ×
/// 2 squares of such pixels whose four values agree within 1/255; and noise, as the mean distance of V from the median of 3
/// × 3 such pixels. A smooth ramp has little of both. Each is absent where there is no such square.
struct Grain {
    std::optional<double> plateau, noise;
};
Grain grain(const ScoredFrame& frame);

/// Share of M where abs(V − V*) < 3σ* though σ* > 0; absent for an exact truth.
std::optional<double> unresolved(const ScoredFrame& frame);

/// Shares of the whole frame whose grey, round(255 (0.3 + 0.7 V)) of 255, differs from the truth's by at most so many steps;
/// pixels outside M have the truth's grey. Zápotocký's score of Table 5.4, a comparison of pictures pixel by pixel (A.3),
/// which allows "a small difference" and names none.
struct PictureCorrectness {
    double within2 = 0, within8 = 0, within16 = 0, within30 = 0;
};

/// Absent where there is no penumbra, as in a hard truth.
std::optional<PictureCorrectness> pictureCorrectness(const ScoredFrame& frame);

/// FLIP between the shaded picture and the one with V*, mean over all pixels. Pixels outside M have V*.
std::optional<double> pictureFlip(const ShadedFrame& frame);

/// Pixels that one texel of the technique's map covers where it is stretched most.
struct Aliasing {
    double median = 0, p95 = 0; // over the receiver pixels that lie in a map
    double mapped = 0;          // their share of all receiver pixels
};

/// The projected-texel-to-pixel ratio: perspective and projection aliasing in one number (Scherzer 2.2.2, Fig. 2.9; course,
/// "Perspective Shadow Maps"). With J the Jacobian from image position to texels along the plane through a receiver pixel's
/// world position at right angles to its normal, the pixel's ratio is 1 over the smallest singular value of J: the pixels
/// that one texel covers where it is stretched most. Above 1 the map is undersampled. J is taken over 1/1024 pixel on the
/// side of the pixel's centre where the map changes less, so that a border between two maps does not count. Pixels of M in
/// no map, or edge-on to eye or light, are not `mapped`; absent if none is.
std::optional<Aliasing> aliasing(const MappedFrame& frame);

/// The error of the last still frame over pixels and seeds. rmse² is systematic² + noise² but for the last digits.
struct SeedErrors {
    double rmse = 0;       // root mean square of V − V*
    double bias = 0;       // mean of V − V*
    double systematic = 0; // rms over M of what all seeds have in common: the mean over seeds without end, less V*
    double noise = 0;      // root of the mean over M of the variance over the seeds
};

/// Both parts are unbiased as squares: the variance of a pixel is taken with n − 1, and what the mean over n seeds keeps of
/// it does not count as systematic. Absent with fewer than two seeds.
std::optional<SeedErrors> seedErrors(const SeedFrames& frames);

/// The mean of one sample or more, and half its 95 % interval by Student's t: 0 of one sample and of equal ones.
struct MeanInterval {
    double mean, half;
};
MeanInterval meanInterval(const std::vector<double>& samples);

/// Number of the first frame, counted from 1, from which the error stays ≤ 1.05 × its steady state, the mean of the last
/// tenth of the frames (at least one). Absent without frames and for an error still restless at the end.
std::optional<int> convergence(const StillFrames& frames);

/// Share of M that differs by more than 30/255 from the technique's own last still frame, by frame (EGSR paper, Fig. 3:
/// "differing from the fully converged solution").
std::vector<double> changedByFrame(const StillFrames& frames);

/// Per-pixel flicker excess abs((V_t − warp V_{t−1}) − (V*_t − warp V*_{t−1})) over every pixel in both masks. The previous
/// frame is read bilinearly where all four pixels are in its mask on the same surface, else at the nearest pixel if that one
/// is, else the pixel is left out. `floor` is the mean for an image that is lit throughout and never changes.
struct Flicker {
    double mean = 0, p95 = 0, floor = 0;
    std::optional<double> perDegree; // mean over that of the motion (`motion` in frames.h); absent where nothing moves
};
std::optional<Flicker> flicker(const MovingFrames& frames);

/// Share of the reprojected pixels (nearest) whose class, lit or not, changes while the truth's does not.
std::optional<double> flipRate(const MovingFrames& frames);

/// Root mean square of V − V* over M of all frames but the first, and over those pixels of it that the frame before did not
/// show.
struct MovingErrors {
    std::optional<double> all, disoccluded;
};
MovingErrors movingErrors(const MovingFrames& frames);

/// Frames after which what a history still shows of shadows that came or went has halved. A pixel counts from the frame in
/// which V* jumps by more than ½, at it and at its eight neighbours, for as long as V* then rests; where it was before is
/// followed by reprojection. Of all pixels of one age the image shows the share g of the old shadow that makes
/// V* + g (V*before − V*) nearest to V. Between two ages g falls exponentially; where it has not halved by the last age, it
/// goes on as from the first age to the last. Absent where the technique keeps no history, no ghost is seen (g < 0.05 in the
/// first frame, fewer than 32 pixels) or it does not fade.
std::optional<double> ghostHalfLife(const MovingFrames& frames);

/// How many pixels flipRate compares and movingErrors are over.
struct MovingPixels {
    double compared = 0, all = 0, disoccluded = 0;
};
MovingPixels movingPixels(const MovingFrames& frames);

/// Share of the surface pixels that the frame before showed, too.
std::optional<double> reuse(const MovingFrames& frames);

// Levels of detail (Scherzer and Wimmer 2008, 5.2).
std::optional<double> standingPop(const Walk& walk);
std::optional<double> standingRegion(const Walk& walk);
std::optional<double> walkPop(const Walk& walk);
std::optional<double> colourError(const Walk& walk);
std::optional<double> noise(const Walk& walk); // absent where no pixel sees a transition
std::optional<double> orderError(const Walk& walk);
std::optional<double> transitions(const Walk& walk);
std::optional<double> primitives(const Walk& walk);
std::optional<double> primitiveChange(const Walk& walk); // but from the first frame, which also fills histories

} // namespace shadowbench::metrics
