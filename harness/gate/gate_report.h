// The report of a gate.
#pragma once

#include "harness/gate/gate.h"

#include <string>

namespace shadowbench::gate {

/// "text" for a terminal or "md": the verdict, what is worse and how to see it again, what could not be judged, and the
/// slowest parts.
std::string gateReport(const GateResult& result, const GateOptions& options, const std::string& format);

/// The same in 40 lines of Markdown at most, for a comment on a request: what is looser and the worst first.
std::string gateComment(const GateResult& result, const GateOptions& options);

} // namespace shadowbench::gate
