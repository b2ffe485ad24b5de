// The error of pixel areas against exact rays, measured at a sample of the pixels (docs/ground-truth.md, "Pixel areas").
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/hard/exact.h"

#include <map>
#include <string>

namespace shadowbench::groundtruth {

/// Pixels that each reference is certified at, exact rays across and down each of them, and sets of so many.
constexpr int pixelCertificatePoints = 256, pixelCertificateRays = 16, pixelCertificateSets = 4;

/// Errors are areas − rays, in visible share, over the points; the rays of a point are the mean of its sets. In rms errors
/// each point weighs as much as its surface fills of the pixel.
struct PixelCertificate {
    int points = 0; // compared: three quarters partly lit, the others fully lit or shadowed, as far as there are
    int contradicting =
        0;                // pixels of the whole image that are fully lit or shadowed against the exact label of their centre
    int impossible = 0;   // points further from their rays than one honest certificate in 100,000 has any
    double bias = 0;      // mean error
    double biasError = 0; // its standard error: each pixel has rays of its own, so the errors are independent
    double rms = 0;       // root of the mean squared error
    double expected = 0;  // the same, by the rays' own sets and σ*, if the areas are right
    double excess = 0;    // mean of the squared errors, less what the rays' own sets and σ* say that they are
    double excessError = 0; // its standard error
    double largest = 0;     // absolute error
    double independent = 0; // rms error that as many independent rays would have
};

/// Compares `means` (ExactScene::averageOverPixels) with `labels` of the same frame (labelByRays) everywhere, and with rays
/// at `points` pixels, the same ones each time; points whose surface the rays of a set miss do not count. The result does
/// not depend on `threads`. `firstSet`: of the rays.
PixelCertificate certifyPixels(const hard::ExactScene& scene, const Reference& means, const Reference& labels, int points,
                               int threads, const Progress& progress = {}, std::uint16_t firstSet = 0);

/// Throws Inconclusive, with what is wrong in a sentence, unless
/// * no pixel that is fully lit or shadowed contradicts its exact label;
/// * no point is further from its rays than rays can be, one honest certificate in 100,000 excepted (Bernstein's
/// inequality);
/// * the rms error is at most 0.75 times that of independent rays, or 1.75 times what is expected of the rays. The rays of a
/// point lie one
///   in each cell of a grid, which leaves them about a third of that error where shadows are wider than a cell, and all of
///   it where they are not, as of grass seen from afar;
/// * with 32 points or more, the bias and the excess are 0 within 4.5 standard errors. What rays err by on this scene is
///   measured, as the spread of sets of rays at each point, so an error of the areas that is well below it shows.
void requirePixelsCertified(const PixelCertificate& certificate);

/// As entries of Provenance::measured: their names start with "certificate_".
std::map<std::string, double> measured(const PixelCertificate& certificate);

} // namespace shadowbench::groundtruth
