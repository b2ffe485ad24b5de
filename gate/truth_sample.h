// Kept truths computed anew: base and head share a cache, and a wrong truth in it would judge both alike.
#pragma once

#include "gate/judged_cells.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// Computes two of the truths that the cache holds of `scenes` without it: a sentence on each that is another to the bit, or
/// that cannot be computed. Which two a hash of `commit` draws, so every gate looks at others and one of the same commit at
/// the same. What took long to compute is left out, and truths that the cache lacks judged nothing in this gate.
std::vector<std::string> contradictedTruths(const std::vector<JudgedScene>& scenes, Profile profile,
                                            const std::filesystem::path& cache, const std::string& commit, bool quiet);

} // namespace shadowbench::gate
