// What a run measures, and where it leaves it.
#pragma once

#include "harness/cells/measure_options.h"
#include "harness/records/record.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>
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

    /// Told of each scene's records, in order, once all its cells are scored, before any is timed; may be empty.
    std::function<void(const std::vector<Record>&)> sceneScored = {};
};

} // namespace shadowbench
