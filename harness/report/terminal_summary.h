// What a terminal shows of a run: of each scene the rows that matter; everything is in the page.
#pragma once

#include "harness/records/record.h"

#include <string>
#include <vector>

namespace shadowbench::report {

/// The Pareto front of `scene` by rising cost, with the cheapest technique within the tolerance if that is not on it; of a
/// run without times the five least errors. Under it, how many techniques there are and that `page` has them all. "" of a
/// scene of level-of-detail techniques alone.
std::string terminalSummary(const std::vector<Record>& records, const std::string& scene, const std::string& page);

} // namespace shadowbench::report
