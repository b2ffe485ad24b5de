// What `run` and `merge` print once all cells are measured.
#pragma once

#include "harness/runs/run.h"

#include <filesystem>

namespace shadowbench {

/// Writes the report into `out`, prints tables, errors and where everything is; returns the run's exit code.
ExitCode reportResult(const RunResult& result, const std::filesystem::path& out);

} // namespace shadowbench
