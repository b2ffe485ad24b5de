// Tables and figures of the documents as data (papers.json beside this file), rendered with our records beside them.
#pragma once

#include "harness/records/record.h"
#include "report/run_report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench {

/// A column of a published table: what we have measured for it, and the rows' published numbers.
struct PaperColumn {
    std::string title, scene;
    std::string profile; // of the records
    std::string metric;  // path in the record; of the record of a row's variant
    std::string per;     // a row's variant: published numbers and ours are also given as multiples of this row's; "": not
};

struct PaperRow {
    std::string title; // the document's
    std::string variant;
    std::vector<std::optional<double>> published; // a number a column
};

struct PaperTable {
    std::vector<PaperColumn> columns;
    std::vector<PaperRow> rows;
};

/// Error over the frames from an empty history, one curve a variant; a variant without history is a level.
struct PaperChart {
    std::string title, scene;
    std::vector<std::string> variants;
};

struct PaperPage {
    std::string id; // of its heading and its charts' files
    std::string title, where, says;
    std::optional<PaperTable> table;
    std::vector<PaperChart> charts;
};

/// The pages that come with the program.
const std::vector<PaperPage>& paperPages();

/// Throws BadInput naming page and key for what is no list of pages.
std::vector<PaperPage> parsePaperPages(std::string_view json);

/// A page as Markdown, from its second-level heading on; `charts` are the file names of its charts, in order. Numbers that
/// no record has are shown as "–".
std::string paperPage(const PaperPage& page, const std::vector<Record>& records, const std::vector<std::string>& charts);

/// The SVG of a chart; nothing if no record has a curve for it.
std::optional<std::string> paperChart(const PaperChart& chart, const std::vector<Record>& records);

/// Writes report.md and the charts. Throws Inconclusive when gnuplot is missing or fails.
report::Written writePapers(const std::vector<Record>& records, const std::filesystem::path& folder);

} // namespace shadowbench
