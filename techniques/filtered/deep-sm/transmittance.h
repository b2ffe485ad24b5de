// Transmittance along a light ray as a piecewise linear function of depth, and its compression (Lokovic and Veach 2000).
#pragma once

#include <span>
#include <vector>

namespace shadowbench::techniques {

/// A vertex of the function. Two of the same depth are a jump: the first is its upper end.
struct TransmittanceNode {
    float depth, transmittance;
};

/// Vertices by ascending depth and falling transmittance. The function is 1 up to the first vertex's depth, linear between
/// vertices, and constant behind the last.
using Transmittance = std::vector<TransmittanceNode>;

/// The mean of `samples` step functions: those that hit something are stopped there, at the depths of `hits` (ascending).
/// Replaces what `function` holds.
void gatherSteps(std::span<const float> hits, int samples, Transmittance& function);

/// Appends a function with as few vertices as the greedy scheme finds that differs from `exact` by at most `error` anywhere,
/// jumps included, and begins at the same vertex. Each segment starts where the last ended and takes the middle of the
/// slopes that keep within the error of every vertex it passes; the last one takes that which comes closest to the
/// function's end, so that what is fully shadowed stays so.
void compress(std::span<const TransmittanceNode> exact, float error, Transmittance& compressed);

} // namespace shadowbench::techniques
