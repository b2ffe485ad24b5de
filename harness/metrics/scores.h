// What the metrics return: plain numbers, each absent where it does not apply.
#pragma once

#include <optional>

namespace shadowbench {

struct EdgeError { // pixels, technique's shadow edge to the exact one
    double mean = 0, p95 = 0, hausdorff = 0;
    double signedMean = 0; // − shadow too small, + too large
};

struct Accuracy {
    // against the exact hard truth
    std::optional<double> mismatch, mismatchOffEdge, falseShadow, leak;
    std::optional<EdgeError> edgeError;
    // against the soft truth, or a filtered technique against the hard truth
    std::optional<double> rmse, mae, psnr, bad30, bad8, ssim, penumbraRmse, penumbraWidthError, umbraLeak;
    std::optional<double> unresolved; // share of M where abs(V − V*) < 3σ* though σ* > 0
    double primaryMismatch = 0;
};

/// Pixels that one texel of the technique's map covers where it is stretched most (`metrics::aliasing`).
struct Aliasing {
    double median = 0, p95 = 0; // over the receiver pixels that lie in a map
    double mapped = 0;          // their share of all receiver pixels
};

struct Flicker {
    double mean = 0, p95 = 0;
};

} // namespace shadowbench
