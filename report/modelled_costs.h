// Costs that are modelled of graphics cards (docs/gpu-cost.md), as charts and tables have them.
#pragma once

#include "report/summary.h"

#include <string>
#include <vector>

namespace shadowbench::report {

/// Markdown: the scored rows of `scene` by their modelled milliseconds on the first card, with what limits them and the
/// multiple of their lower bounds that their own passes take, and what they cost where they were measured; each with its
/// place among the rows that have all of these. "" where nothing is modelled.
std::string modelledTable(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::report
