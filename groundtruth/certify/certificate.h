// The error of a soft reference against the exact visible fraction, measured at a sample of its pixels
// (docs/ground-truth.md, "Uncertainty").
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/area/area.h"
#include "groundtruth/povray/povray.h"

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::groundtruth {

/// Points that each reference is certified at: the rms error is then known to some 4 %.
constexpr int certificatePointCount = 512;

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

/// The same against the exact oracle, `scene` being that of the request.
Certificate certify(const area::AreaScene& scene, const Request& request, const povray::Render& image,
                    const PrimaryHits& primary, int points, int threads, const Progress& progress = {});

/// The same for a scene that is prepared for this only.
Certificate certify(const Request& request, const povray::Render& image, const PrimaryHits& primary, int points, int threads,
                    const Progress& progress = {});

/// How far a fully lit or fully shadowed pixel may be from the exact fraction: N low-discrepancy samples can miss an
/// occluder of this share of the light, 4 N^(−¾) (the discrepancy of nets for convex sets), and no larger one.
double resolvedTolerance(int samples);

/// Throws Inconclusive, with what is wrong in a sentence, unless the certificate is that of a valid render. The bounds
/// leave room above the errors of valid renders of straight edges, bars, combs and foliage on squares and disks:
/// * no fully lit or umbra pixel is wrong;
/// * every value is a whole number of samples, to a quarter (16-bit files round by at most an eighth): else the samples have
///   different weights, an error too small to be distinguished from that of sampling;
/// * the rms error is at most 1.5 times that of independent samples, the bias at most half of it;
/// * the error falls from the first quarter of the samples to all: to 0.75 times, as both rms are single draws, or to two
///   thirds of the error of independent samples where that is more (the pixels of a comb all see the same pattern, and a
///   quarter of the samples may fit it by luck).
/// 1/N and the bracket are added to each bound. With fewer than 32 points in the penumbra only the first two are required:
/// there is too little to judge by, and little that could be wrong.
void requireCertified(const Certificate& certificate, int samples);

/// `sigma` (povray::samplingUncertainty) scaled so that its rms over the penumbra points is the rms error measured there,
/// where 32 or more were; never below the rounding to a whole number of samples, 1/(N √12).
Image<float> calibrated(Image<float> sigma, const Certificate& certificate, int samples);

/// As entries of Provenance::measured: their names start with "certificate_".
std::map<std::string, double> measured(const Certificate& certificate);

} // namespace shadowbench::groundtruth
