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
    bool quiet = false;
};

struct RunResult {
    std::vector<Record> records;
    ExitCode code = ExitCode::Pass; // of the first cell that ended in an error
};

/// Runs every cell; after each one results.jsonl in `out` holds all finished ones. A cell that fails leaves an error record
/// and the run goes on. With `resume`, cells that results.jsonl already holds (same inputs, same program) are kept.
RunResult run(const RunOptions& options);

} // namespace shadowbench
