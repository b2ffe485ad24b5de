// Whether the numbers of an image are sRGB-encoded though they are taken for linear, or the other way round. Pure functions.
#pragma once

#include "harness/metrics/frames.h"

#include <vector>

namespace shadowbench::foreign {

/// A filter that counts samples shows fractions k/n, and many pixels show the same. Where these are codes of an encoding
/// instead, nothing but the encoding explains it.
struct EncodedFractions {
    int samples = 0;   // n
    int levels = 0;    // of its n − 1 fractions between 0 and 1 that are there
    double chance = 1; // at most the probability that so many values fall so near to codes of any n by chance
};

/// Of values as the file holds them: `code` turns a fraction into what it would hold. Only values of several pixels count.
EncodedFractions encodedFractions(std::vector<float> stored, float (*code)(float));

/// Whether that cannot be chance, and is less so than that the values are fractions as they stand.
bool isSure(const EncodedFractions& encoded, const EncodedFractions& asTheyStand);

/// The grey pixels near exact shadow edges. A filtered edge shows as much above ½ as below, wherever it lies; and where it
/// lies right, its pixels are right on average.
struct GreyPixels {
    int count = 0;
    double evener = 0; // logarithm of the ratio of likelihoods: values are distributed symmetrically about ½ when
                       // the encoding is undone, against as they are
    double before = 0, after = 0; // mean of V − V*, as it is and undone
};

/// For a frame with labels as its truth; `undo` undoes the encoding.
GreyPixels greyPixels(const metrics::ScoredFrame& frame, float (*undo)(float));

/// Whether both speak for the encoding. A technique that brightens edges as much looks alike: no more than a suspicion.
bool isSuspect(const GreyPixels& grey);

} // namespace shadowbench::foreign
