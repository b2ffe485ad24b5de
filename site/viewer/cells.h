// The pages of cells: what a technique shows, the truth and the error, pixel by pixel.
#pragma once

#include "harness/records/record.h"
#include "site/site_writer.h"
#include "site/viewer/sequences.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

/// Whether `images`, the folder that `run` fills (harness/cells/kept_images.h), holds a record's cell and a truth of its
/// size, so that its page exists (`cellAddress` in site/names.h).
bool hasCell(const Record& record, const std::filesystem::path& images);

/// A cell of one of several runs.
struct RunCell {
    std::string name; // that the page calls it by: "pcf", "base:pcf"
    Record record;
    std::filesystem::path images; // of its run
    bool sequence = false;        // its moving frames are shown, too
};

/// Writes cells/<scene>.html for every scene of which `images` holds cells, with what the pages need beside them. `others`
/// stand behind those of the records, for comparison.
void writeCells(const std::vector<Record>& records, const std::filesystem::path& images, SiteWriter& site,
                Sequences sequences = Sequences::Fronts, const std::vector<RunCell>& others = {});

/// Writes cells/<scene>.html with cells of one scene, those whose images there are and have the size of its truths, which
/// are those of the first cell's run. `back`: where the page leads back to. Returns whether it shows any.
bool writeCellPage(const std::vector<RunCell>& cells, const Link& back, SiteWriter& site);

/// The way to a cell on its page, from the site's folder; `against`: what it is compared with, the truth unless named.
std::string cellAddress(const RunCell& cell, const RunCell* against = nullptr);

/// Script and style of the pages of cells. Once, where there are any.
void writeViewer(const SiteWriter& site);

/// Pictures of a cell that has been written: addresses from the site's folder. Nothing where there are none.
/// `truths`: images of the run whose truths the page shows.
struct CellPictures {
    std::string technique, truth, difference;
};
std::optional<CellPictures> cellPictures(const RunCell& cell, const std::filesystem::path& truths, const SiteWriter& site);

/// The same with the scene's shaded pictures (harness/cells/shading.h) in place of visibility, written when first asked for.
/// Nothing where the run has kept no shading.
std::optional<CellPictures> shadedPictures(const RunCell& cell, const SiteWriter& site);

/// The same of a scene's truths, each with what it is the truth of.
std::vector<Link> truthPictures(const std::string& scene, const std::filesystem::path& images, const SiteWriter& site);

} // namespace shadowbench::site
