// A sampled truth of an area light against the exact visible fraction, over the whole image.
#pragma once

#include "groundtruth/contract/reference.h"

namespace shadowbench::groundtruth {

/// Rms of `sampled` − `exact`, of one frame, over the penumbra: receivers where either is partly lit or they differ; 0 if
/// there is none.
struct PenumbraError {
    double rms = 0;
    std::size_t pixels = 0;
};
PenumbraError penumbraError(const Reference& sampled, const Reference& exact);

/// Throws Inconclusive if that rms exceeds 1.5 times the one that the certificate of `sampled` measured at its points: what
/// these missed is wrong. The quarter of a sample that a certificate allows, and half of the exact one's bracket, are added.
/// Not judged where the certificate has fewer than 32 points in the penumbra.
void requireNearExact(const Reference& sampled, const Reference& exact);

} // namespace shadowbench::groundtruth
