// Costs that are modelled of graphics cards (docs/gpu-cost.md), as charts and tables have them.
#pragma once

#include "report/summary.h"

#include <string>
#include <vector>

namespace shadowbench::report {

/// The cards and sizes that records of `scene` are modelled on, each once: "gtx-1080@1920x1080" (Record::modelled).
std::vector<std::string> modelledNames(const std::vector<Record>& records, const std::string& scene);

/// "gtx-1080 at 1920×1080".
std::string cardAndSize(const std::string& name);

/// Milliseconds of a standing frame there; nothing where they are not modelled, and of rows that wait for the program, whose
/// wait the model does not know.
CostOf modelledOn(const std::string& name);

/// Markdown: the scored rows of `scene` by their modelled milliseconds on the first card, with what limits them and the
/// multiple of their lower bounds that their own passes take, and what they cost where they were measured; each with its
/// place among the rows that have all of these. "" where nothing is modelled.
std::string modelledTable(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::report
