// What `run` and `merge` print once all cells are measured.
#pragma once

#include "harness/runs/run.h"

#include <filesystem>
#include <vector>

namespace shadowbench {

struct ResultOptions {
    bool standing = false; // costs are of scenes where light and casters stand still
    bool everyRow = false; // the user named the rows: all are printed, not those alone that matter most
    bool printed = false;  // the tables are, by printTables
};

/// Prints a table of each scene; of records without costs, of the least errors.
void printTables(const std::vector<Record>& records, const std::filesystem::path& out, const ResultOptions& options);

/// Writes the report into `out`, prints tables, errors and where everything is; returns the run's exit code. Throws BadInput
/// with the reasons where no technique applies to its scene.
ExitCode reportResult(const RunResult& result, const std::filesystem::path& out, const ResultOptions& options = {});

} // namespace shadowbench
