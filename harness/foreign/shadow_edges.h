// What a shift of a whole image does to all its shadow edges alike, and a technique's errors do not. The truth tells: exact
// distances from shadow edges, or graded penumbrae. Pure functions.
#pragma once

#include "harness/metrics/frames.h"

#include <glm/vec2.hpp>

namespace shadowbench::foreign {

/// How much better a shift explains where edges lie than something else does: logarithms of ratios of likelihoods, summed
/// over the squares of the image. In each, differences from the truth have a Laplace distribution of a width of its own, so
/// what a technique draws precisely counts, and what it draws badly does not.
struct ShiftEvidence {
    glm::ivec2 by{0, 0};      // the likeliest of up to two whole pixels each way; {0, 0}: no shift
    double towardsLight = 0;  // against none, at edges that it moves towards the light,
    double towardsShadow = 0; // and at those that it moves towards the shadow: all of a light that is too large move one way
    double agreement = 0; // the sum of both over its spread by chance, were each square's evidence for or against by chance
    double overHalf = 0;  // against half as far, and half as far again: what moves in the world moves by more pixels where
    double overMore = 0;  // it is near
};

/// `labels`: the truth is 0 or 1, and distances from the exact edges are compared; else visibilities in penumbrae.
ShiftEvidence shiftEvidence(const metrics::ScoredFrame& frame, bool labels);

/// Whether all speak for it, and whether squares agree so much that they leave no doubt.
bool isSuspect(const ShiftEvidence& evidence);
bool isSure(const ShiftEvidence& evidence);

} // namespace shadowbench::foreign
