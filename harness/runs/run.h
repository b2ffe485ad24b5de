// The main job: scenes × techniques → records, kept cell by cell.
#pragma once

#include "base/error.h"
#include "harness/cells/scene_cells.h"
#include "harness/records/record.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench {

struct RunOptions {
    std::vector<std::string> scenes;     // ids or files; empty: the standard scenes
    std::vector<std::string> techniques; // variants or globs; empty: all
    Profile profile = Profile::Gate;
    std::filesystem::path out = "results/latest";
    std::filesystem::path cache;
    MeasureOptions measure; // of every cell
    bool resume = false;
    bool instructions = false; // counted of a steady frame, under Callgrind
    int jobs = 0;              // processes that score cells at the same time; 0: as many as the machine runs at once
    bool quiet = false;
};

struct RunResult {
    std::vector<Record> records;
    ExitCode code = ExitCode::Pass; // of the first cell that ended in an error
};

/// Runs every cell: scores them in several processes, then times one after the other. After each one results.jsonl in `out`
/// holds all finished ones. A cell that fails leaves an error record and the run goes on. With `resume`, what results.jsonl
/// already holds of cells (same inputs, same program) is kept. Must be called without a GL context.
RunResult run(const RunOptions& options);

} // namespace shadowbench
