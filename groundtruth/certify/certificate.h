// The error of a soft reference against the exact visible fraction, measured at a sample of its pixels
// (docs/ground-truth.md, "Uncertainty").
#pragma once

#include "base/progress.h"
#include "groundtruth/certify/honest_renders.h"
#include "groundtruth/cgal/area/area.h"
#include "groundtruth/povray/povray.h"

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace shadowbench::groundtruth {

/// Raise it with every change of what is refused: what an older program certified counts no longer.
constexpr int certificateVersion = 1;

/// Points that each reference under an area light is certified at, as many as take about a second: the rms error is then
/// known to 2 %, and a fault in a hundredth of the fully lit pixels escapes one certificate in two hundred.
constexpr int certificatePointCount = 4096;

/// Errors are render − exact (the middle of a disk's bracket), in visible fraction, over the points in the penumbra: where
/// the render or the exact fraction is neither 0 nor 1. All are 0 if there is none.
struct Certificate {
    int points = 0;         // compared; points that see the light edge-on have no exact fraction and do not count
    int penumbra = 0;       // of them in the penumbra
    int wrong = 0;          // of them rendered as fully lit or umbra, and further from that than resolvedTolerance
    double bias = 0;        // mean error
    double rms = 0;         // root of the mean squared error
    double largest = 0;     // absolute error
    double rmsHalf = 0;     // rms error of the first half of the light samples …
    double rmsQuarter = 0;  // … and of their first quarter
    double independent = 0; // rms error to be expected of as many independent random light samples: √(mean of v(1 − v)/N)
    double uneven = 0;      // furthest of a rendered value from a whole number of samples, in samples; 0 to ½
    double bracket = 0;     // half the widest bracket of an exact fraction; 0 but for disks
    double sigma = 0;       // rms of povray::samplingUncertainty at the same points, for calibrated
    double replayed = 0; // mean distance of a rendered value from what the render's own samples see, in samples; 0 for skies
    std::optional<HonestBounds> honest; // with 32 points or more that are partly lit; none for skies
};

/// The exact visible fraction at a pixel that sees a receiver.
using ExactFraction = std::function<area::VisibleFraction(glm::ivec2)>;

/// Pixels to certify `image` at, at most `points`: receivers that POV-Ray sees too; three quarters of them where the light
/// is not resolved (povray::unresolvedPixels), the rest halved between fully lit and umbra; what a kind lacks goes to the
/// others. Each kind is cut along a space-filling curve into equal parts of which each gives one pixel: the same ones each
/// time.
std::vector<glm::ivec2> certificatePoints(const povray::Render& image, const PrimaryHits& primary, int points);

/// Compares a render of `samples` light samples with `exact` at certificatePoints, on `threads` threads; the result does not
/// depend on their number.
Certificate certify(const povray::Render& image, const PrimaryHits& primary, int samples, int points, int threads,
                    const ExactFraction& exact, const Progress& progress = {});

/// The same against the exact oracle, `scene` being that of the request, with what renders of other sample sets leave there.
/// `set` of povray::lightSample: what the render was made of.
Certificate certify(const area::AreaScene& scene, const Request& request, const povray::Render& image,
                    const PrimaryHits& primary, int points, int threads, const Progress& progress = {},
                    std::uint32_t set = 0);

/// The same for a scene that is prepared for this only.
Certificate certify(const Request& request, const povray::Render& image, const PrimaryHits& primary, int points, int threads,
                    const Progress& progress = {});

/// How far a fully lit or fully shadowed pixel may be from the exact fraction: N low-discrepancy samples can miss an
/// occluder of this share of the light, 4 N^(−¾) (the discrepancy of nets for convex sets), and no larger one.
double resolvedTolerance(int samples);

/// Throws Inconclusive, with what is wrong in a sentence, unless the certificate is that of a valid render:
/// * no fully lit or umbra pixel is wrong;
/// * every value is a whole number of samples, to a quarter (16-bit files round by at most an eighth): else the samples have
///   different weights, an error too small to be distinguished from that of sampling;
/// * over the penumbra, values differ by a quarter of a sample at most, on average, from what the render's own samples see
///   exactly: a light moved by 1/(4N) of its side is beyond that;
/// * the mean error, the rms error and its fall from the first quarter of the samples to all are those of honest renders of
///   this scene: each within a quantile of them that one in 100,000 exceeds, and the quarter of a sample beside. So a sample
///   set that is worse than the recipe's is refused even if the render equals it. With fewer than 32 points in the penumbra
///   this is not required: there is too little to judge by, and little that could be wrong.
void requireCertified(const Certificate& certificate, int samples);

/// `sigma` (povray::samplingUncertainty) scaled so that its rms over the penumbra points is the rms error measured there,
/// where 32 or more were; never below the rounding to a whole number of samples, 1/(N √12).
Image<float> calibrated(Image<float> sigma, const Certificate& certificate, int samples);

/// As entries of Provenance::measured: their names start with "certificate_".
std::map<std::string, double> measured(const Certificate& certificate);

} // namespace shadowbench::groundtruth
