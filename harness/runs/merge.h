// Joins the cells that parts of a run have measured, and judges them as a whole run does.
#pragma once

#include "harness/runs/run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::shards {

struct Merged {
    RunResult result;                 // in the manifest's order
    std::vector<std::string> missing; // a sentence for each cell without a whole file; `result` then says nothing
};

/// The cells of the folders, each of which holds a manifest and some of its cells: the same result in whatever order folders
/// are named and cells were finished. Of a cell that was measured twice with the same scores the earlier record stays.
/// Throws BadInput when a folder has no manifest or another one than the others; Inconclusive when cells were measured by
/// other commits or in different environments, or twice with different scores. All name what differs, and where.
Merged merge(std::vector<std::filesystem::path> folders);

/// Without what differs from one measurement of a cell to the next: date and times.
Record withoutTimings(Record record);

/// The cells' images of a folder, in another one.
void copyImages(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace shadowbench::shards
