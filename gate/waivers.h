// Changes for the worse that a waiver accepts.
#pragma once

#include "gate/gate_config.h"
#include "harness/records/compare.h"

#include <string>
#include <vector>

namespace shadowbench::gate {

/// "2026-12-31", UTC.
std::string today();

/// Makes what is Worse or NotCompared and of a waiver's cells and class Waived, with the reason in its sentence. `today` as
/// "2026-12-31": a waiver holds through its last day. Returns a sentence for each that has expired or accepts nothing.
std::vector<std::string> waive(std::vector<Change>& changes, const std::vector<Waiver>& waivers, const std::string& today);

} // namespace shadowbench::gate
