#include "harness/runs/kept_cells.h"

#include "base/files.h"
#include "harness/cells/environment.h"
#include "harness/records/comparability.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>

namespace shadowbench {
namespace {

using shards::ManifestCell;
using shards::MeasuredCell;

std::string lineOf(const Record& record) { return toJson(record) + "\n"; }

bool isSameCell(const Record& a, const Record& b) {
    return a.scene == b.scene && a.variant == b.variant && a.profile == b.profile;
}

} // namespace

RecordsFile::RecordsFile(const RunOptions& options, std::size_t cells)
    : file_(options.out / "results.jsonl"), lines_(cells) {
    if (options.resume && std::filesystem::exists(file_)) {
        earlier_ = readRecords(file_);
        std::erase_if(earlier_, [](const Record& r) { return r.commit != builtFrom().hash || r.program != programHash(); });
    }
    std::ranges::transform(earlier_, std::back_inserter(earlierLines_), lineOf);
}

std::optional<MeasuredCell> RecordsFile::find(std::size_t /*cell*/, const Record& blank) const {
    const auto found = std::ranges::find_if(earlier_, [&](const Record& r) {
        return r.status != Status::Error && r.cell == blank.cell &&
               (isExternal(r) || !gate::difference(r.environment, blank.environment, gate::EnvironmentScope::OfScores));
    });
    if (found == earlier_.end()) return {};
    return MeasuredCell{"", *found};
}

void RecordsFile::keep(std::size_t cell, MeasuredCell measured) {
    lines_[cell] = lineOf(measured.record);
    for (std::size_t i = 0; i < earlier_.size(); ++i)
        if (isSameCell(earlier_[i], measured.record)) earlierLines_[i].clear();
    std::string all;
    for (const auto& lines : {std::cref(lines_), std::cref(earlierLines_)})
        for (const std::string& line : lines.get()) all += line;
    writeFile(file_, all);
}

CellFiles::CellFiles(const RunOptions& options, const std::vector<ManifestCell>& manifest)
    : folder_(options.out), manifest_(manifest) {}

std::optional<MeasuredCell> CellFiles::find(std::size_t cell, const Record& /*blank*/) const { return valid(cell); }

std::optional<MeasuredCell> CellFiles::valid(std::size_t cell) const {
    const ManifestCell& planned = manifest_[cell];
    try {
        std::optional<MeasuredCell> known = shards::readCell(folder_, planned.id);
        const bool isValid = known && known->record.status != Status::Error && known->record.commit == planned.commit &&
                             known->record.program == planned.program;
        return isValid ? known : std::nullopt;
    } catch (const BadInput&) {
        return std::nullopt; // a damaged one is replaced
    }
}

bool CellFiles::isFinished(std::size_t cell) const {
    const std::optional<MeasuredCell> known = valid(cell);
    return known && shards::hasCosts(known->record, manifest_[cell].cost);
}

void CellFiles::keep(std::size_t cell, MeasuredCell measured) {
    if (measured.transient) return;
    measured.id = manifest_[cell].id;
    shards::writeCell(folder_, measured);
}

} // namespace shadowbench
