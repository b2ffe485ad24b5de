// Variants of a technique in which any two choices of its parameters come together: a fault in a choice that no shown
// variant makes is found, too.
#pragma once

#include "techniques/catalog.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// Whether a row of choices can be made.
using GoTogether = std::function<bool(const std::vector<std::size_t>&)>;

/// Rows of choices, one for each of `sizes`, a number from 0 to the size: every two choices of different columns that can be
/// made together are in some row together. Few rows, by the greedy rule of AETG (Cohen et al. 1997) without its chance.
std::vector<std::vector<std::size_t>> pairwiseRows(const std::vector<std::size_t>& sizes, const GoTogether& goTogether);

/// What a parameter is tried with: all of its words, or of a range its default and its lower end, which is the cheaper one.
std::vector<std::string> choicesOf(const techniques::Parameter& parameter);

/// Canonical names of variants that cover every two choices of the technique's parameters.
std::vector<std::string> pairwiseVariants(const techniques::Entry& entry);

} // namespace shadowbench::gate
