// What is published of level-of-detail techniques; nothing of it mixes with shadows.
#pragma once

#include "harness/records/record.h"

#include "report/text_table.h"

#include <optional>
#include <string>
#include <vector>

namespace shadowbench::report {

/// The table of one scene's walk for a terminal; "" without level-of-detail records.
std::string lodTerminalTable(const std::vector<Record>& records, const std::string& scene);

/// The same in Markdown, with every column and what they mean.
std::string lodMarkdownTable(const std::vector<Record>& records, const std::string& scene);

/// The same without what surrounds it; without rows where there are no level-of-detail records.
TextTable lodTable(const std::vector<Record>& records, const std::string& scene);

/// Change of colour beyond lod-full's and frame time along the walk, as SVG; nothing without curves.
std::optional<std::string> lodChart(const std::vector<Record>& records, const std::string& scene);

/// Markdown and SVG of a sweep over the viewport: frame times, their ratios to lod-switch's, and the counters that explain
/// them. `records` are timed, not empty, and have equal sizes in every curve.
std::string viewportTable(const std::vector<Record>& records);
std::string viewportChart(const std::vector<Record>& records);

} // namespace shadowbench::report
