// The pages of cells: what a technique shows, the truth and the error, pixel by pixel.
#pragma once

#include "harness/records/record.h"
#include "harness/report/site/site_writer.h"

#include <filesystem>
#include <vector>

namespace shadowbench::site {

/// Whether `images`, the folder that `run` fills (harness/cells/kept_images.h), holds a record's cell and a truth of its
/// size, so that its page exists (`cellAddress` in harness/report/site/names.h).
bool hasCell(const Record& record, const std::filesystem::path& images);

/// Which cells' sequences the pages hold: those of the Pareto fronts (where nothing was timed, of the ten rows of a scene
/// with least error), or all.
enum class Sequences { Fronts, All };

/// Writes cells/<scene>.html for every scene of which `images` holds cells, with what the pages need beside them.
void writeCells(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site,
                Sequences sequences = Sequences::Fronts);

} // namespace shadowbench::site
