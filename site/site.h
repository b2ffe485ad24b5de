// Pages for browsers, made from records and the pictures beside them (docs/pages.md).
#pragma once

#include "harness/records/record.h"
#include "history/history_report.h"
#include "site/viewer/sequences.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::site {

/// What a site shows.
struct Sources {
    std::vector<Record> records;                    // of runs and sweeps, in the order in which they are shown
    std::filesystem::path images = {};              // as `run --images` leaves them; missing: no cells are shown
    std::optional<std::vector<Record>> base = {};   // older records, for gate.html
    std::string baseName = {};                      // how the user names them
    std::filesystem::path baseImages = {};          // as `images`
    std::optional<history::Findings> findings = {}; // for history.html
    Sequences sequences = Sequences::Fronts;        // whose moving frames the pages of cells hold
    std::vector<std::string> named = {};            // variants and techniques that charts label beside the front
    bool standing = false;                          // costs are of scenes where light and casters stand still
};

/// Writes the report (writeReport in report/run_report.h), index.html, all other pages and what they need; returns
/// the path of index.html. Writes over the files of a former site in `folder`. Throws Inconclusive when gnuplot is missing
/// or fails.
std::filesystem::path writeSite(const Sources& sources, const std::filesystem::path& folder);

/// Writes the site in `folder` as one file that needs no other: pages become parts of it that links show one at a time.
void writeSingleFile(const std::filesystem::path& folder, const std::filesystem::path& file);

} // namespace shadowbench::site
