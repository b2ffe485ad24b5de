// Other renderers' rows stand in tables and charts, and never beside our costs.
#include "harness/report/charts.h"
#include "harness/report/run_report.h"
#include "harness/report/summary.h"
#include "harness/report/terminal_summary.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

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
    EXPECT_TRUE(contains(page, "| external:my-engine | 0.05 % |")) << page;
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
    EXPECT_TRUE(contains(*chart, "external:my-engine"));
    EXPECT_TRUE(contains(*chart, "cost not measured here"));
    EXPECT_FALSE(contains(*report::paretoChart(hardScene(), scene), "cost not measured here"));
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
