// The frozen list of what a run in parts will measure, one cell a line (JSON Lines): every part works from the same one.
#pragma once

#include "harness/records/record.h"
#include "harness/runs/run_options.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::shards {

/// A line of the manifest: a cell by its inputs.
struct ManifestCell {
    std::string id; // 32 hex digits, the name of its file: hash of all below but `images`, `commit`, `dirty` and `program`,
                    // and of all that its scores depend on (scene, truths, their tools)
    std::string scene, variant;
    std::string profile;
    std::uint32_t seed = 1;
    std::vector<std::string> cost; // what is measured beside work counters: "time", "instructions", "screen"
    bool images = false;
    std::string commit; // of the program that measures
    bool dirty = false;
    std::string program; // its hash

    bool operator==(const ManifestCell&) const = default;
};

/// Whether a record has a kind of cost, or needs none: it is not scored, or another renderer's.
bool hasCost(const Record& record, std::string_view kind);
bool hasCosts(const Record& record, const std::vector<std::string>& kinds); // all of them

/// The kinds that a run measures: ManifestCell::cost.
std::vector<std::string> costsOf(const RunOptions& options);

/// The cells of a run, scene by scene in the order of its records. Measures nothing and computes no truth; throws
/// Inconclusive if a tool is missing that a cell's truth needs.
std::vector<ManifestCell> plannedCells(const RunOptions& options);

std::filesystem::path manifestFile(const std::filesystem::path& folder);

/// Replaces the file, whole or not at all.
void writeManifest(const std::filesystem::path& folder, const std::vector<ManifestCell>& cells);

/// Throws BadInput naming file and line of what is no manifest.
std::vector<ManifestCell> readManifest(const std::filesystem::path& folder);

/// In words, the first thing in which `other` differs from `manifest`, such as "seed is 1, not 2"; nothing if they are
/// equal.
std::optional<std::string> difference(const std::vector<ManifestCell>& manifest, const std::vector<ManifestCell>& other);

/// Makes `planned` the folder's manifest from now on. Throws BadInput naming what differs when it has another one.
void freezeManifest(const std::filesystem::path& folder, const std::vector<ManifestCell>& planned);

/// Cells [first, last) of the manifest.
struct CellRange {
    std::size_t first = 0, last = 0;
};

/// Shard `text` = "i/n", i in 1 … n, of `cells` cells: blocks of neighbours whose sizes differ by one at most, so that a
/// shard's cells share scenes and truths. Throws BadInput for other texts.
CellRange shardRange(const std::string& text, std::size_t cells);

/// Cell `number`, counted from 1 as the manifest's lines are. Throws BadInput if there is none.
CellRange cellRange(std::size_t number, std::size_t cells);

} // namespace shadowbench::shards
