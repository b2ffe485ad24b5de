// The two charts of a scene, as SVG.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// Headline error against cost, both logarithmic, with the Pareto front and the tolerance; nothing if no record was timed.
std::optional<std::string> paretoChart(const std::vector<Record>& records, const std::string& scene);

/// Error over the still frames from an empty history: against the truth, and against the technique's own last image; nothing
/// without curves.
std::optional<std::string> convergenceChart(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::report
