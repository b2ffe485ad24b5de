// What `run` and `merge` print once all cells are measured.
#pragma once

#include "harness/runs/run.h"

#include <filesystem>

namespace shadowbench {

/// Writes the report into `out`, prints tables, errors and where everything is; returns the run's exit code. `standing`:
/// costs are of scenes where light and casters stand still.
ExitCode reportResult(const RunResult& result, const std::filesystem::path& out, bool standing = false);

} // namespace shadowbench
