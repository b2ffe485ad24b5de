// Errors of hard shadows that lie at random. A renderer's do not: its edges are filtered or displaced, and what it loses or
// shadows wrongly elsewhere are stripes and patches. Those of an image that is the truth with noise do.
#pragma once

#include "base/image.h"
#include "groundtruth/contract/reference.h"

#include <vector>

namespace shadowbench::gate {

/// Pixels of one scene, and those of them that are wrong. Of what is far from shadow edges: lit ones, dark ones, and pairs
/// of neighbours.
struct ErrorPlaces {
    struct Share {
        double wrong = 0, all = 0;
    };
    Share nearEdges, lit, dark, pairs;
};

/// Adds those of an image of visibilities.
void addErrors(const Image<float>& v, const groundtruth::Reference& truth, ErrorPlaces& places);

/// Whether on each scene pixels near edges are as often wrong as others, lit ones as well as dark ones, and one beside a
/// wrong one no more often than any. False where that is of too few errors to say.
bool lieAtRandom(const std::vector<ErrorPlaces>& scenes);

} // namespace shadowbench::gate
