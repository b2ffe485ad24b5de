// What is said of a run as a whole: where it comes from, and how it is made again.
#pragma once

#include "harness/records/record.h"

#include <string>
#include <vector>

namespace shadowbench::report {

/// The commits of the records, each once: "3f2a… with uncommitted changes".
std::string commitsOf(const std::vector<Record>& records);

/// Rasterisers, processors and compilers, each combination once; "" where no record says any.
std::string environmentsOf(const std::vector<Record>& records);

/// The command that measures the records' cells, as a shell takes it. `records` are not empty.
std::string runCommand(const std::vector<Record>& records);

/// What a scene's cells were scored against, and by which tools.
std::string sceneTruth(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::report
