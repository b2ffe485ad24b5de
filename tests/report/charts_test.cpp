#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "report/charts.h"
#include "report/families.h"
#include "report/gnuplot.h"
#include "report/labels.h"
#include "report/run_report.h"
#include "tests/support/report_examples.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
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

/// "#7F00FF" as gnuplot writes it: "127,   0, 255".
std::string rgbOf(const std::string& colour) {
    const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
    return fmt::format("{:3}, {:3}, {:3}", part(1), part(3), part(5));
}

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

report::Box markAt(glm::dvec2 mark) { return {mark - 6.0, mark + 6.0}; }

TEST(Labels, CrossNoLabelNoMarkAndNoFrameInACrowd) {
    std::vector<report::LabelledPoint> points;
    report::Surroundings around{.area = {{100, 80}, {900, 540}}, .marks = {}, .taken = {{{800, 90}, {900, 104}}}};
    for (int i = 0; i < 14; ++i) // a cluster as of variants of one technique: some at the very same place
        points.push_back(report::labelled({300 + 13 * (i % 5), 200 + 9 * (i % 3)}, "technique:option=" + std::to_string(i)));
    for (const report::LabelledPoint& point : points) around.marks.push_back(point.at);
    for (int i = 0; i < 60; ++i) around.marks.emplace_back(200 + 11 * i, 150 + (53 * i) % 300); // that have no label
    const std::vector<std::optional<report::PlacedLabel>> placed = report::placeLabels(points, around);
    ASSERT_EQ(placed.size(), points.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        ASSERT_TRUE(placed[i]) << i;
        const report::Box& box = placed[i]->box;
        EXPECT_TRUE(around.area.contains(box)) << i;
        EXPECT_FALSE(box.overlaps(around.taken.front())) << i;
        for (const glm::dvec2 mark : around.marks) EXPECT_FALSE(box.overlaps(markAt(mark))) << i;
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(box.overlaps(placed[j]->box)) << i << " and " << j;
    }
}

TEST(Labels, AreLeftOutWhereThereIsNoFreePlace) {
    const report::Surroundings around{.area = {{0, 0}, {60, 40}}, .marks = {{30, 20}}};
    EXPECT_FALSE(report::placeLabels({report::labelled({30, 20}, "a-name-that-is-wider")}, around)[0]);
}

TEST(Labels, LieRightOfALonelyPointUnlessALineRunsThere) {
    report::Surroundings around{.area = {{0, 0}, {400, 400}}, .marks = {{200, 200}}};
    const std::vector<report::LabelledPoint> point{report::labelled({200, 200}, "pcf")};
    EXPECT_EQ(report::placeLabels(point, around)[0]->side, glm::ivec2(1, 0));
    EXPECT_FALSE(report::placeLabels(point, around)[0]->leader);
    around.lines = {{{200, 200}, {400, 200}}};
    EXPECT_EQ(report::placeLabels(point, around)[0]->side, glm::ivec2(-1, 0));
}

TEST(Labels, AreAsWideAsTheirLetters) {
    EXPECT_DOUBLE_EQ(report::textWidth("iii", 12), 12 * 3 * 0.222);
    EXPECT_DOUBLE_EQ(report::textWidth("mm", 12), 12 * 2 * 0.833);
    EXPECT_DOUBLE_EQ(report::textWidth("≈", 10), 10);
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

TEST(LogAxis, LeavesOutLabelsThatWouldLieOnThatOfZero) {
    const report::LogAxis axis({0.0, 1.6e-6, 1.0}); // the floor is at 6.5e-8
    EXPECT_FALSE(contains(axis.script("y", 1, ""), "'1e-07' ")) << axis.script("y", 1, "");
    EXPECT_TRUE(contains(axis.script("y", 1, ""), "'1e-06' ")) << axis.script("y", 1, "");
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
    EXPECT_FALSE(contains(*report::paretoChart(records, "overlapping-occluders", {"pcss"}), "≈"));
    records[2].reference->area = AreaInfo{"a", "b", 0.004, 0.0209};
    EXPECT_TRUE(contains(*report::paretoChart(records, "overlapping-occluders", {"pcss"}), "pcss ≈ temporal-soft"));
}

TEST(Charts, LabelTheFrontAndWhatTheUserNames) {
    std::vector<Record> records = hardScene();
    records.push_back(hardCell("pcf:kernel=7", 0.2, 3));
    const auto labelled = [](const std::optional<std::string>& svg) { return contains(svg.value(), ">pcf:kernel=7<"); };
    EXPECT_TRUE(contains(*report::paretoChart(records, "dueling-frusta"), ">volume-zfail<"));
    EXPECT_FALSE(labelled(report::paretoChart(records, "dueling-frusta")));
    EXPECT_TRUE(labelled(report::paretoChart(records, "dueling-frusta", {"pcf:kernel=7"})));
    EXPECT_TRUE(labelled(report::paretoChart(records, "dueling-frusta", {"pcf"})));
    EXPECT_FALSE(labelled(report::paretoChart(records, "dueling-frusta", {"esm"})));
}

TEST(Charts, ShowEachPointInItsFamilysColourAndNameTheFamilies) {
    const std::string svg = *report::paretoChart(hardScene(), "dueling-frusta");
    for (const char* technique : {"sm-uniform", "volume-zfail", "none"})
        EXPECT_TRUE(contains(svg, fmt::format("rgb({}", rgbOf(report::familyOf(technique).colour)))) << technique;
    EXPECT_TRUE(contains(svg, ">shadow volumes<"));
    EXPECT_FALSE(contains(svg, ">levels of detail<"));
}

TEST(Charts, OfModelledCostsAreOfOneCardAndSize) {
    std::vector<Record> records = hardScene();
    EXPECT_FALSE(report::modelledChart(records, "dueling-frusta", "h200@1920x1080"));
    for (Record& record : records) record.modelled["h200@1920x1080"] = {2, 1, 4, record.technique.starts_with("sm-"), {}};
    const std::string svg = report::modelledChart(records, "dueling-frusta", "h200@1920x1080").value();
    EXPECT_TRUE(contains(svg, "cost: ms on h200 at 1920×1080, modelled: the dearer of standing and in motion")) << svg;
    EXPECT_TRUE(contains(svg, ">shadow volumes<"));
    EXPECT_FALSE(contains(svg, ">shadow maps<")) << "these wait for the program";
    EXPECT_FALSE(report::modelledChart(records, "dueling-frusta", "h200@3840x2160"));
}

TEST(Charts, AreAbsentWithoutCostsOrCurves) {
    std::vector<Record> records = {hardCell("a", 0.1, 1)};
    clear(records[0], "cost.time");
    EXPECT_FALSE(report::paretoChart(records, "dueling-frusta"));
    EXPECT_FALSE(report::convergenceChart(records, "dueling-frusta"));
}

TEST_F(ReportFolder, HoldsThePageTheFiguresAndTheCharts) {
    std::vector<Record> records = hardScene();
    records[0].modelled["h200@1920x1080"] = {2, 1, 4, false, {}};
    for (const Record& record : softScene()) records.push_back(record);
    const report::Written written = report::writeReport(records, folder());
    EXPECT_EQ(written.page, folder() / "report.md");
    EXPECT_EQ(written.charts,
              (std::vector<std::filesystem::path>{
                  folder() / "modelled-h200-1920x1080-dueling-frusta.svg", folder() / "pareto-dueling-frusta.svg",
                  folder() / "convergence-dueling-frusta.svg", folder() / "passes-dueling-frusta.svg",
                  folder() / "pareto-overlapping-occluders.svg", folder() / "passes-overlapping-occluders.svg"}));
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
