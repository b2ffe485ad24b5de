// What a terminal shows of a run: of each scene the rows that matter; everything is in the page.
#pragma once

#include "harness/records/record.h"

#include <string>
#include <vector>

namespace shadowbench::report {

enum class Rows { Front, All };

/// The Pareto front of `scene` by rising cost, with the technique that is advised if that is not on it; of a run without
/// times the five least errors. `All`: every row as the records have them, and why techniques do not apply. Under it, how
/// many techniques there are and that `page` has them all. "" of a scene of level-of-detail techniques alone.
std::string terminalSummary(const std::vector<Record>& records, const std::string& scene, const std::string& page,
                            Rows shown = Rows::Front);

} // namespace shadowbench::report
