// The report of a gate.
#pragma once

#include "gate/gate.h"

#include <string>

namespace shadowbench::gate {

/// For a terminal: what is looser than the base, what is worse and how to see it again, what could not be judged, the
/// slowest parts and the verdict.
std::string gateReport(const GateResult& result, const GateOptions& options);

/// The same in 40 lines of Markdown at most, for a comment on a request: what is looser and the worst first.
std::string gateComment(const GateResult& result, const GateOptions& options);

} // namespace shadowbench::gate
