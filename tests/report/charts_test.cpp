#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "report/charts.h"
#include "report/gnuplot.h"
#include "report/labels.h"
#include "report/run_report.h"
#include "tests/support/report_examples.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class ReportFolder : public testing::Test {
protected:
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

private:
    TemporaryFolder owner_;
    std::filesystem::path folder_ = owner_.path();
};

/// An environment variable for the length of a scope.
class ScopedVariable {
public:
    ScopedVariable(const char* name, const char* value) : name_(name), before_(std::getenv(name)) { setenv(name, value, 1); }
    ~ScopedVariable() { setenv(name_, before_.c_str(), 1); }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

private:
    const char* name_;
    std::string before_;
};

TEST(Labels, NeverOverlapInACrowd) {
    std::vector<report::LabelledPoint> points(14);
    for (int i = 0; i < 14; ++i) // a cluster as of variants of one technique: some at the very same place
        points[i] = {{300 + 13 * (i % 5), 200 + 9 * (i % 3)}, "technique:option=" + std::to_string(i)};
    const report::Box area{{100, 80}, {900, 540}};
    const std::vector<report::PlacedLabel> placed = report::placeLabels(points, area, {}, {6.4, 16});
    ASSERT_EQ(placed.size(), points.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_TRUE(area.contains(placed[i].box)) << i;
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(placed[i].box.overlaps(placed[j].box)) << i << " and " << j;
    }
}

TEST(Labels, LieRightOfALonelyPointUnlessALineRunsThere) {
    const report::Box area{{0, 0}, {400, 400}};
    const std::vector<report::LabelledPoint> point{{{200, 200}, "pcf"}};
    EXPECT_EQ(report::placeLabels(point, area, {}, {6, 16})[0].side, glm::ivec2(1, 0));
    EXPECT_EQ(report::placeLabels(point, area, {{{200, 200}, {400, 200}}}, {6, 16})[0].side, glm::ivec2(-1, 0));
    EXPECT_FALSE(report::placeLabels(point, area, {}, {6, 16})[0].leader);
}

TEST(LogAxis, DrawsZeroOnALabelledFloorBelowEveryOtherValue) {
    const report::LogAxis axis({0.0, 0.01, 1.0});
    EXPECT_LT(axis.drawn(0), 0.01);
    EXPECT_GT(axis.position(0), 0);
    EXPECT_LT(axis.position(0), axis.position(0.01));
    EXPECT_LT(axis.position(1), 1);
    EXPECT_TRUE(contains(axis.script("y", 100, " %%"), "'0 %%' "));
    EXPECT_TRUE(contains(axis.script("y", 100, " %%"), "'100 %%' 1)")) << axis.script("y", 100, " %%");
    EXPECT_FALSE(contains(report::LogAxis({0.01, 1.0}).script("y", 1, ""), "'0' "));
}

TEST(LogAxis, HasARangeForOneValueForZerosAndForNone) {
    for (const std::vector<double>& values :
         {std::vector<double>{3.0}, std::vector<double>{0.0, 0.0}, std::vector<double>{}}) {
        const report::LogAxis axis(values);
        EXPECT_LT(0, axis.low());
        EXPECT_LT(axis.low(), axis.high());
        EXPECT_TRUE(std::isfinite(axis.position(values.empty() ? 1 : values[0])));
    }
}

TEST(Gnuplot, TakesNoMeaningFromText) {
    EXPECT_EQ(report::literal("it's `date` $x\n"), "'it''s `date` $x '");
    std::vector<Record> records = hardScene();
    records[0].variant = "a'b\"`touch /tmp/x`<&>%s\\";
    const std::optional<std::string> svg = report::paretoChart(records, "dueling-frusta");
    ASSERT_TRUE(svg);
    EXPECT_TRUE(contains(*svg, "a'b\"`touch /tmp/x`&lt;&amp;>%s\\")) << *svg;
}

TEST(Charts, OfTheSameRecordsAreTheSameBytes) {
    EXPECT_EQ(report::paretoChart(hardScene(), "dueling-frusta"), report::paretoChart(hardScene(), "dueling-frusta"));
    EXPECT_EQ(report::convergenceChart(hardScene(), "dueling-frusta"),
              report::convergenceChart(hardScene(), "dueling-frusta"));
}

TEST(Charts, NameBesideARowThoseThatItCannotBeToldFrom) {
    std::vector<Record> records = softScene();
    records[1].reference->area = AreaInfo{"a", "b", 0.004, 0.0206};
    EXPECT_FALSE(contains(*report::paretoChart(records, "overlapping-occluders"), "≈"));
    records[2].reference->area = AreaInfo{"a", "b", 0.004, 0.0209};
    EXPECT_TRUE(contains(*report::paretoChart(records, "overlapping-occluders"), "pcss ≈ temporal-soft"));
}

TEST(Charts, AreAbsentWithoutCostsOrCurves) {
    std::vector<Record> records = {hardCell("a", 0.1, 1)};
    clear(records[0], "cost.time");
    EXPECT_FALSE(report::paretoChart(records, "dueling-frusta"));
    EXPECT_FALSE(report::convergenceChart(records, "dueling-frusta"));
}

TEST_F(ReportFolder, HoldsThePageTheFiguresAndTheCharts) {
    std::vector<Record> records = hardScene();
    for (const Record& record : softScene()) records.push_back(record);
    const report::Written written = report::writeReport(records, folder());
    EXPECT_EQ(written.page, folder() / "report.md");
    EXPECT_EQ(written.charts, (std::vector<std::filesystem::path>{
                                  folder() / "pareto-dueling-frusta.svg", folder() / "convergence-dueling-frusta.svg",
                                  folder() / "passes-dueling-frusta.svg", folder() / "pareto-overlapping-occluders.svg",
                                  folder() / "passes-overlapping-occluders.svg"}));
    for (const std::filesystem::path& chart : written.charts) EXPECT_TRUE(contains(readFile(chart), "</svg>")) << chart;
    EXPECT_EQ(readFile(folder() / "results.csv"), report::csv(records));

    const std::string page = readFile(written.page);
    for (const char* part :
         {"## dueling-frusta", "![pareto-dueling-frusta](pareto-dueling-frusta.svg)", "c0ffee", "llvmpipe",
          "exact (polygon) by CGAL 5.5.1", "POV-Ray 1024 samples, σ 0.0006 by povray 3.7.0.10.unofficial",
          "./bench run --scene dueling-frusta --scene overlapping-occluders --technique ", " --profile gate\n",
          "## The columns"})
        EXPECT_TRUE(contains(page, part)) << part;
}

TEST_F(ReportFolder, IsNotMadeWithoutGnuplotWhichIsNamed) {
    const ScopedVariable noPath("PATH", folder().c_str());
    try {
        report::writeReport(hardScene(), folder());
        FAIL();
    } catch (const Inconclusive& error) {
        EXPECT_TRUE(contains(error.what(), "apt-get install gnuplot-nox")) << error.what();
    }
}

TEST_F(ReportFolder, OfNoRecordsSaysSo) {
    const report::Written written = report::writeReport({}, folder());
    EXPECT_TRUE(written.charts.empty());
    EXPECT_TRUE(contains(readFile(written.page), "No records."));
}

} // namespace
} // namespace shadowbench
