#include "harness/runs/merge.h"

#include "base/files.h"
#include "harness/records/comparability.h"
#include "harness/runs/cell_file.h"
#include "harness/runs/manifest.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace shadowbench::shards {
namespace fs = std::filesystem;
namespace {

/// A cell's measurement and the file it lies in.
struct Found {
    MeasuredCell cell;
    fs::path file;
};

std::vector<ManifestCell> commonManifest(const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders)
        if (!fs::exists(manifestFile(folder)))
            throw BadInput(fmt::format("{} holds no manifest.jsonl: it is no folder of `run --shard` or `run --cell`",
                                       folder.string()));
    std::vector<ManifestCell> manifest = readManifest(folders.front());
    for (const fs::path& folder : folders)
        if (const auto differs = difference(manifest, readManifest(folder)))
            throw BadInput(fmt::format("{} and {} belong to different runs: {}", manifestFile(folders.front()).string(),
                                       manifestFile(folder).string(), *differs));
    return manifest;
}

/// Trees with changes have their commit in common, and nothing else: their programs' hashes tell them apart.
void requireProgram(const Found& found, const ManifestCell& cell) {
    const Record& record = found.cell.record;
    if (record.commit == cell.commit && record.dirty == cell.dirty && record.program != cell.program)
        throw Inconclusive(fmt::format("{} was measured by another program of commit {}{}: its sources or its compiler "
                                       "differ; measure the cell again with one program",
                                       found.file.string(), cell.commit, cell.dirty ? " with changes" : ""));
    if (record.commit == cell.commit && record.dirty == cell.dirty) return;
    throw Inconclusive(fmt::format("{} was measured by commit {}{}, the manifest is of {}{}; measure the cell again", //
                                   found.file.string(), record.commit, record.dirty ? " with changes" : "", cell.commit,
                                   cell.dirty ? " with changes" : ""));
}

void requireSameScores(const Found& a, const Found& b) {
    if (toJson(withoutTimings(a.cell.record)) == toJson(withoutTimings(b.cell.record))) return;
    throw Inconclusive(fmt::format("{} and {} are the same cell with different scores: the program or the machine is not "
                                   "deterministic; find out which, remove the wrong one",
                                   a.file.string(), b.file.string()));
}

bool isEarlier(const Found& a, const Found& b) {
    return std::tuple(a.cell.record.time, toJson(a.cell.record)) < std::tuple(b.cell.record.time, toJson(b.cell.record));
}

/// The cell in one of the folders; what is missing or damaged goes to `missing`.
std::optional<Found> find(const std::vector<fs::path>& folders, const ManifestCell& cell, std::size_t number,
                          std::vector<std::string>& missing) {
    std::optional<Found> kept;
    std::string damage = "no folder has " + cellFile("", cell.id).string();
    for (const fs::path& folder : folders) {
        try {
            std::optional<MeasuredCell> measured = readCell(folder, cell.id);
            if (!measured) continue;
            const Found found{std::move(*measured), cellFile(folder, cell.id)};
            requireProgram(found, cell);
            if (!hasCosts(found.cell.record, cell.cost))
                throw BadInput(fmt::format("{} has scores, and not yet all costs", found.file.string()));
            if (kept) requireSameScores(*kept, found);
            if (!kept || isEarlier(found, *kept)) kept = found;
        } catch (const BadInput& error) {
            damage = error.what();
        }
    }
    if (!kept) missing.push_back(fmt::format("cell {}, {} on {}: {}", number, cell.variant, cell.scene, damage));
    return kept;
}

void requireOneEnvironment(const std::vector<Found>& cells) {
    const Found* first = nullptr;   // that was drawn here: where other renderers ran is not our concern
    const Found* counted = nullptr; // the first with a Valgrind
    for (const Found& found : cells) {
        if (isExternal(found.cell.record)) continue;
        if (first == nullptr) first = &found;
        if (counted == nullptr && found.cell.record.environment.valgrind) counted = &found;
        for (const Found* other : {first, counted == nullptr ? first : counted})
            if (const auto differs = gate::difference(other->cell.record.environment, found.cell.record.environment,
                                                      gate::EnvironmentScope::All))
                throw Inconclusive(fmt::format("cells were measured in different environments: {} in {} and {}; measure all "
                                               "of them on machines of one kind",
                                               *differs, other->file.string(), found.file.string()));
    }
}

RunResult resultOf(const std::vector<Found>& cells) {
    RunResult result;
    for (const Found& found : cells) {
        result.records.push_back(found.cell.record);
        if (result.code == ExitCode::Pass) result.code = found.cell.code;
    }
    return result;
}

} // namespace

Merged merge(std::vector<fs::path> folders) {
    if (folders.empty()) throw BadInput("merge joins the folders of a run in parts; name at least one");
    std::sort(folders.begin(), folders.end());
    const std::vector<ManifestCell> manifest = commonManifest(folders);
    Merged merged;
    std::vector<Found> cells;
    for (std::size_t i = 0; i < manifest.size(); ++i)
        if (auto found = find(folders, manifest[i], i + 1, merged.missing)) cells.push_back(std::move(*found));
    requireOneEnvironment(cells);
    if (merged.missing.empty()) merged.result = resultOf(cells);
    return merged;
}

Record withoutTimings(Record record) {
    record.time.clear();
    for (const metrics::Metric& line : metrics::table)
        if (line.noisy) record.values.clear(line);
    for (auto* passes : {&record.passes, &record.motionPasses, &record.coldPasses})
        for (PassRecord& pass : *passes) {
            pass.milliseconds.reset();
            pass.share.reset();
        }
    record.otherScreen.reset(); // measured for its times
    record.deviceCosts.clear();
    record.modelled.clear(); // another verb adds them
    if (record.external) record.external->reported.reset();
    return record;
}

void copyImages(const fs::path& from, const fs::path& to) {
    const fs::path images = from / "images";
    if (!fs::is_directory(images) || fs::weakly_canonical(from) == fs::weakly_canonical(to)) return;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(images))
        if (entry.is_regular_file())
            writeFile(to / "images" / entry.path().lexically_relative(images), readFile(entry.path()));
}

} // namespace shadowbench::shards
