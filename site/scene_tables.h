// The tables of one scene.
#pragma once

#include "harness/records/record.h"
#include "report/costing.h"
#include "site/site_writer.h"
#include "site/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::site {

/// A technique's own cell of a table: its name, its title, and the way to its cell's page where there are images.
Cell techniqueCell(const Record& record, const std::filesystem::path& images);

/// What filters go by: family, answer, whether it is within the tolerances; "baseline", "front" and the interval of its
/// cost.
std::vector<std::pair<std::string, std::string>> marksOf(const std::vector<Record>& records, std::size_t index);

/// The column of costs that are modelled on a card, and a row's cell.
Column modelledColumn(const report::Costing& costing);
Cell modelledCell(const Record& record, const report::Costing& costing);

/// The chart of error against cost of the scene, drawn from `table`.
Chart costChart(const std::vector<Record>& records, const std::string& scene, const std::string& table);

/// Every scored technique with every metric that applies to one of them.
Table errorTable(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images);

/// A number of each frame, a row a record: those of `list`, shown as values of `metric` (a name for bounds, or "" for what
/// is no share); without rows where no record has the list.
struct FrameList {
    metrics::MetricId list;
    std::string metric, id, caption;
};
Table frameTable(const std::vector<Record>& records, const std::string& scene, const FrameList& shown,
                 const std::filesystem::path& images);

/// Milliseconds by pass; without rows where no record has them.
Table passTable(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images);

/// Techniques that do not apply or ended in an error, with the reason.
Table unscoredTable(const std::vector<Record>& records, const std::string& scene);

} // namespace shadowbench::site
