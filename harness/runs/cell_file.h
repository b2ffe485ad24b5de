// A measured cell's file: <folder>/cells/<id>.json, written whole or not at all.
#pragma once

#include "base/error.h"
#include "harness/records/record.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::shards {

struct MeasuredCell {
    std::string id; // ManifestCell::id; "" outside of manifests
    Record record;
    ExitCode code = ExitCode::Pass; // what a whole run would end with for it: other than Pass with an error record only
    bool transient = false;         // an error that may not come again
};

/// As JSON on one line, and back. The latter throws BadInput when the text is none.
std::string text(const MeasuredCell& cell);
MeasuredCell measuredCell(const std::string& text);

std::filesystem::path cellFile(const std::filesystem::path& folder, const std::string& id);

/// Throws InternalError naming the file when it cannot be written, and leaves no partial one.
void writeCell(const std::filesystem::path& folder, const MeasuredCell& cell);

/// All of a folder, by their ids. Throws BadInput naming the first that is damaged.
std::vector<MeasuredCell> readCells(const std::filesystem::path& folder);

/// Nothing if there is no such file. Throws BadInput naming the file when it is damaged or another cell's.
std::optional<MeasuredCell> readCell(const std::filesystem::path& folder, const std::string& id);

} // namespace shadowbench::shards
