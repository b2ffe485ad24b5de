// The least of a resource with which techniques stay within a scene's tolerance, read off records
// (docs/metrics.md, "Adequacy").
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::recommend {

enum class Resource {
    MapTexels, // `map`: texels along a side of a shadow map
    Samples,   // `n` light samples, `taps` of a search or filter
};

/// How much of the resource the value of a parameter asks for: map=512 is 512, taps=16+16 is 32 samples; nothing for other
/// parameters.
std::optional<double> amount(Resource resource, const std::string& parameter, const std::string& value);

/// Variants over the amounts that are tried of every technique that has the parameter: maps of 256 to 4096 texels a side, 4
/// to 256 light samples, all choices of taps. `patterns` as of a run; empty: all techniques. Throws BadInput when none has
/// the parameter.
std::vector<std::string> variantsOver(Resource resource, const std::vector<std::string>& patterns);

/// The least amount of one technique.
struct Least {
    std::string variant;
    double amount;
    double error; // by the first tolerance's metric
};

/// Of every technique, with its other parameters the same, that the records show with at least two amounts: the least one
/// from which on all larger ones are within all of the scene's tolerances. A smaller one that is, while one above it is not,
/// is within by luck. Techniques whose largest amount is not within are left out. The least amount first, then the least
/// error. Throws BadInput when there is no such technique to compare.
std::vector<Least> leastAdequate(const std::vector<Record>& records, const std::string& scene, Resource resource);

} // namespace shadowbench::recommend
