// Measures a part of a manifest's cells. It judges nothing: `merge` does, once all are there.
#pragma once

#include "harness/runs/manifest.h"

#include <string>
#include <vector>

namespace shadowbench::shards {

struct Measured {
    std::size_t cells = 0;              // of the part
    std::size_t kept = 0;               // that had a valid file
    std::vector<std::string> errors;    // a sentence for each cell that ended in an error which would recur: a measurement
    std::vector<std::string> transient; // for each that has no file and is worth a retry
};

/// Measures the cells of `range` that have no valid file yet, each into its own. A file is valid if it is this cell's, of
/// this program, and no error. `manifest` is that of `options.out`. Throws InternalError when a file cannot be
/// written.
Measured measureCells(const RunOptions& options, const std::vector<ManifestCell>& manifest, CellRange range);

} // namespace shadowbench::shards
