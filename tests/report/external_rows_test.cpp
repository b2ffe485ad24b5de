// Other renderers' rows stand in tables and charts, and never beside our costs.
#include "report/charts.h"
#include "report/run_report.h"
#include "report/summary.h"
#include "report/terminal_summary.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <regex>

namespace shadowbench {
namespace {

using namespace test;

constexpr const char* scene = "dueling-frusta";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Less wrong than all others but one, and by its own account cheaper.
Record externalRow() {
    Record row = hardCell("external:my-engine", 0.0005, 0.001);
    row.technique = row.variant;
    row.external = {.title = "My engine", .source = "version 4", .reported = ReportedCost{0.25, "a GPU"}};
    return row;
}

std::vector<Record> withExternal() {
    std::vector<Record> records = hardScene();
    Record row = externalRow();
    row.values["cost.time.ratio"].reset();
    records.push_back(row);
    return records;
}

TEST(ExternalRows, HaveAnErrorAndNoPlaceAmongCosts) {
    std::vector<Record> records = hardScene();
    const std::vector<std::size_t> before = report::paretoFront(records, scene);
    records.push_back(externalRow()); // even with a ratio that somebody wrote into the record
    EXPECT_FALSE(report::place(records.back()));
    EXPECT_EQ(report::paretoFront(records, scene), before);
    EXPECT_EQ(report::frontMark(records, scene, records.size() - 1), "");
    EXPECT_TRUE(headline(records.back()));
}

TEST(ExternalRows, StandInTheTableWithWhatTheyReportSaidToBeReported) {
    const std::string page = report::markdownTable(withExternal(), scene);
    EXPECT_TRUE(contains(page, "| My engine<br><sub>external:my-engine</sub> | 0.05 % |")) << page;
    EXPECT_TRUE(contains(page,
                         "time of a frame as the renderers themselves report it, not measured here: external:my-engine "
                         "0.25 ms (a GPU)"))
        << page;
    EXPECT_TRUE(contains(page, "external:my-engine: My engine (version 4)")) << page;
}

TEST(ExternalRows, AreAlwaysInTheTerminal) {
    const std::string text = report::terminalSummary(withExternal(), scene, "page.md");
    EXPECT_TRUE(contains(text, "external:my-engine")) << text;
    EXPECT_TRUE(contains(text, "Pareto front and other renderers: ")) << text;
    EXPECT_FALSE(contains(report::terminalSummary(hardScene(), scene, "page.md"), "other renderers"));
}

TEST(ExternalRows, HaveAStripOfTheirOwnBesideTheChart) {
    const std::optional<std::string> chart = report::paretoChart(withExternal(), scene);
    ASSERT_TRUE(chart);
    EXPECT_TRUE(contains(*chart, "my-engine"));
    EXPECT_TRUE(contains(*chart, "cost not measured here"));
    EXPECT_FALSE(contains(*report::paretoChart(hardScene(), scene), "cost not measured here"));
}

/// The heights of the texts of a chart that hold these words, in pixels.
std::vector<double> heightsOf(const std::string& svg, const std::string& words) {
    const std::regex text("<g transform=\"translate\\([^,]*,([^)]*)\\)[^>]*>\\s*<text>[^<]*(?:<tspan[^>]*>)?[^<]*" + words);
    std::vector<double> heights;
    for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it) heights.push_back(std::stod((*it)[1]));
    return heights;
}

std::string chartWith(int rows) {
    std::vector<Record> records = hardScene();
    for (int i = 0; i < rows; ++i) {
        Record row = externalRow();
        row.technique = row.variant = "external:engine-" + std::to_string(i);
        row.values["accuracy.mismatch"] = 0.02 + 0.0001 * i; // all but the same height
        records.push_back(row);
    }
    return *report::paretoChart(records, scene);
}

/// Names of rows that err alike were written over each other.
TEST(ExternalRows, AreNamedInTheStripOneBelowAnother) {
    std::vector<double> heights = heightsOf(chartWith(25), "engine-");
    ASSERT_EQ(heights.size(), 25U);
    std::ranges::sort(heights);
    for (std::size_t i = 1; i < heights.size(); ++i)
        EXPECT_GE(heights[i] - heights[i - 1], 12) << i; // as high as letters are
}

TEST(ExternalRows, AreNamedWhileThereIsRoomForNames) {
    const std::string chart = chartWith(50);
    EXPECT_LT(heightsOf(chart, "engine-").size(), 50U);
    EXPECT_TRUE(contains(chart, "not named)"));
    EXPECT_TRUE(contains(chart, "engine-0<"));
    EXPECT_FALSE(contains(chart, "engine-49<")); // has the greatest error
    EXPECT_FALSE(contains(chartWith(25), "not named)"));
}

TEST(ExternalRows, ComeBackFromJsonAsTheyWere) {
    const Record row = externalRow();
    const Record read = parseRecord(toJson(row));
    EXPECT_EQ(toJson(read), toJson(row));
    EXPECT_EQ(read.external->reported->device, "a GPU");
    EXPECT_TRUE(isExternal(read));
    EXPECT_TRUE(contains(report::csv({row}), "external.reported.milliseconds"));
}

} // namespace
} // namespace shadowbench
