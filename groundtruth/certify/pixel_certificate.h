// The error of pixel areas against exact rays, measured at a sample of the pixels (docs/ground-truth.md, "Pixel areas").
#pragma once

#include "base/progress.h"
#include "groundtruth/cgal/hard/exact.h"

#include <map>
#include <string>

namespace shadowbench::groundtruth {

/// Pixels that each reference is certified at, and exact rays across and down each of them.
constexpr int pixelCertificatePoints = 256, pixelCertificateRays = 16;

/// Errors are areas − rays, in visible share, over the points.
struct PixelCertificate {
    int points = 0; // compared: three quarters partly lit, the others fully lit or shadowed, as far as there are
    int contradicting =
        0;              // pixels of the whole image that are fully lit or shadowed against the exact label of their centre
    double bias = 0;    // mean error
    double rms = 0;     // root of the mean squared error
    double largest = 0; // absolute error
    double independent = 0; // rms error that as many independent rays would have
};

/// Compares `means` (ExactScene::averageOverPixels) with `labels` of the same frame (labelByRays) everywhere, and with rays
/// at `points` pixels, the same ones each time. The result does not depend on `threads`.
PixelCertificate certifyPixels(const hard::ExactScene& scene, const Reference& means, const Reference& labels, int points,
                               int threads, const Progress& progress = {});

/// Throws Inconclusive, with what is wrong in a sentence, unless
/// * no pixel that is fully lit or shadowed contradicts its exact label;
/// * the rms error is at most 0.75 times, and with 32 points or more the bias at most 0.3 times, that of independent rays.
///   The rays of a point lie one in each cell of a grid, which leaves them about a third of that error.
void requirePixelsCertified(const PixelCertificate& certificate);

/// As entries of Provenance::measured: their names start with "certificate_".
std::map<std::string, double> measured(const PixelCertificate& certificate);

} // namespace shadowbench::groundtruth
