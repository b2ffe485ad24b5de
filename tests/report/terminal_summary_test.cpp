// What a terminal shows of a run.
#include "report/terminal_summary.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(TerminalSummary, ShowsTheFrontAndHowManyTechniquesThePageHas) {
    std::vector<Record> records = test::hardScene();
    records.push_back(test::hardCell("sm-tsm", 0.06, 1.4)); // worse than sm-uniform, and dearer
    const std::string text = report::terminalSummary(records, "dueling-frusta", "out/report.md");
    EXPECT_TRUE(has(text, "sm-uniform") && has(text, "volume-zfail")) << text;
    EXPECT_FALSE(has(text, "sm-tsm")) << text;
    EXPECT_TRUE(has(text, "Pareto front: 4 of 5 techniques; not applicable: 1; the full table: out/report.md")) << text;
}

TEST(TerminalSummary, TheCheapestWithinATolerancesOwnMetricIsThereThoughItIsNotOnTheFront) {
    std::vector<Record> records = {test::hardCell("a", 0.01, 1), test::hardCell("b", 0.02, 2), test::hardCell("c", 0, 3)};
    for (Record& record : records) {
        record.tolerances = {{"leak", 0.05}};
        record.values["accuracy.leak"] = record.variant == "a" ? 0.5 : 0.0;
    }
    const std::string text = report::terminalSummary(records, "dueling-frusta", "report.md");
    EXPECT_TRUE(has(text, "cheapest within tolerance (leak 5 %): b")) << text;
    EXPECT_LT(text.find(" a "), text.find(" b ")) << text;
    EXPECT_LT(text.find(" b "), text.find(" c ")) << text;
}

TEST(TerminalSummary, WithoutTimesItShowsTheLeastErrors) {
    std::vector<Record> records;
    for (int i = 0; i < 40; ++i) {
        records.push_back(test::hardCell("t" + std::to_string(i), 0.5 - 0.01 * i, 1));
        test::clear(records.back(), "cost.time");
    }
    const std::string text = report::terminalSummary(records, "dueling-frusta", "report.md");
    EXPECT_LT(text.find("t39"), text.find("t35")) << text;
    EXPECT_FALSE(has(text, "t34")) << text;
    EXPECT_TRUE(has(text, "least errors: 5 of 40 techniques; the full table: report.md")) << text;
    EXPECT_LE(std::ranges::count(text, '\n'), 10);
}

TEST(TerminalSummary, OfRowsThatTheUserNamedItShowsAllAndWhyOneDoesNotApply) {
    const std::vector<Record> records = {test::hardCell("sm-uniform", 0.01, 1), test::hardCell("sm-tsm", 0.06, 1.4),
                                         test::unscored(Status::NotApplicable, "needs an area light")};
    const std::string text = report::terminalSummary(records, "dueling-frusta", "report.md", report::Rows::All);
    EXPECT_TRUE(has(text, " sm-uniform ") && has(text, " sm-tsm ")) << text;
    EXPECT_TRUE(has(text, "not applicable: sm-history:base=lispsm (needs an area light)")) << text;
}

TEST(TerminalSummary, OfASceneWhereNothingIsScoredItSaysSo) {
    const std::vector<Record> records = {test::unscored(Status::NotApplicable, "needs an area light")};
    const std::string text = report::terminalSummary(records, records.front().scene, "report.md");
    EXPECT_EQ(text, " dueling-frusta: no technique is scored; not applicable: 1\n");
}

} // namespace
} // namespace shadowbench
