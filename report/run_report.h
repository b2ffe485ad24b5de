// Published forms of records: tables, charts and a page. Every figure comes from the records; only the page's command line
// also asks which scenes and techniques there are, so as not to name them all.
#pragma once

#include "harness/records/record.h"
#include "report/summary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::report {

/// The table a person sees for one scene: technique, error, false shadow, leak, edge error, flicker, cost, front; of `rows`,
/// indices of the scene's records. Under it the advice (report/advice.h), which is of all. Plain text.
std::string terminalTable(const std::vector<Record>& records, const std::string& scene,
                          const std::vector<std::size_t>& rows);
std::string terminalTable(const std::vector<Record>& records, const std::string& scene); // of all its records

std::string markdownTable(const std::vector<Record>& records, const std::string& scene);

/// Markdown: the error of every technique of one sweep at every value, and the value at which it breaks. Not empty.
std::string sweepTable(const std::vector<Record>& records);

/// One row a record, every metric a column, absent ones empty.
std::string csv(const std::vector<Record>& records);

/// Indices of the records of `scene` that no other one beats in headline error and cost ratio (`dominates` in
/// report/summary.h), by rising cost.
std::vector<std::size_t> paretoFront(const std::vector<Record>& records, const std::string& scene,
                                     const CostOf& costOf = frameCost);

/// Writes report.md, results.csv and the charts (SVG, by gnuplot): pareto-<scene>.svg for every scene, where costs are
/// modelled modelled-<card and size>-<scene>.svg,
/// convergence-<scene>.svg where a record has curves; where records have costs by pass, passes.csv, and costs.md and
/// passes-<scene>.svg where these are timed. Throws Inconclusive when gnuplot is missing or fails, naming the
/// package.
struct Written {
    std::filesystem::path page;
    std::vector<std::filesystem::path> charts;
};
/// `named`: variants and techniques that charts label beside the Pareto front.
Written writeReport(const std::vector<Record>& records, const std::filesystem::path& folder,
                    const std::vector<std::string>& named = {});

} // namespace shadowbench::report
