// The main job: scenes × techniques → records, kept cell by cell.
#pragma once

#include "base/error.h"
#include "harness/records/record.h"
#include "harness/runs/manifest.h"
#include "harness/runs/run_options.h"

#include <string>
#include <vector>

namespace shadowbench {

struct RunResult {
    std::vector<Record> records;
    ExitCode code = ExitCode::Pass; // of the first cell that ended in an error
};

/// Runs every cell: scores them in several processes, then times one after the other. After each one results.jsonl in `out`
/// holds all finished ones. A cell that fails leaves an error record and the run goes on. With `resume`, what results.jsonl
/// already holds of cells (same inputs, same program) is kept. Must be called without a GL context.
RunResult run(const RunOptions& options);

namespace shards {

struct Measured {
    std::size_t cells = 0;              // of the part
    std::size_t kept = 0;               // that had a valid file
    std::vector<std::string> errors;    // a sentence for each cell that ended in an error which would recur: a measurement
    std::vector<std::string> transient; // for each that has no valid file and is worth a retry
};

/// Measures the cells of `range` that have no valid file yet, each into its own. A file is valid if it is this cell's, of
/// this program, no error, and has all costs that are asked for. `manifest` is that of `options.out`. It judges nothing:
/// `merge` does, once all are there. Throws InternalError when a file cannot be written.
Measured measureCells(const RunOptions& options, const std::vector<ManifestCell>& manifest, CellRange range);

} // namespace shards
} // namespace shadowbench
