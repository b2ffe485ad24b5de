// The pages of cells: what a technique shows, the truth and the error, pixel by pixel.
#pragma once

#include "harness/records/record.h"
#include "harness/report/site/site_writer.h"

#include <filesystem>
#include <vector>

namespace shadowbench::site {

/// Whether `images`, the folder that `run --images` writes, holds the pictures of a record's cell, so that its page exists
/// (`cellAddress` in harness/report/site/names.h).
bool hasCell(const Record& record, const std::filesystem::path& images);

/// Writes cells/<scene>.html for every scene of which `images` holds cells, with what the pages need beside them.
void writeCells(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site);

} // namespace shadowbench::site
