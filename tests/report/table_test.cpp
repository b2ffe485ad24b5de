#include "report/run_report.h"
#include "report/summary.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

std::vector<std::string> variants(const std::vector<Record>& records, const std::vector<std::size_t>& indices) {
    std::vector<std::string> result;
    result.reserve(indices.size());
    for (const std::size_t i : indices) result.push_back(records[i].variant);
    return result;
}

TEST(TerminalTable, ListsEveryTechniqueAndEndsWithTheCheapestWithinTolerance) {
    EXPECT_EQ(report::terminalTable(hardScene(), "dueling-frusta"),
              " scene: dueling-frusta · 256² · error = mismatching pixels · cost = standing frames of sm-uniform\n"
              " technique                 error   false shadow     leak   edge error px   flicker   cost   front\n"
              " none                     31.2 %              –    100 %               –    0.1040   0.31       ○\n"
              " sm-uniform               4.87 %         0.05 %   0.04 %            0.40    0.0162   1.00       ●\n"
              " sm-history:base=lispsm   0.09 %         0.05 %   0.04 %            0.40    0.0003   1.19       ●\n"
              " volume-zfail             0.00 %         0.05 %   0.04 %            0.40    0.0000   4.70       ●\n"
              " truth: exact (polygon)\n"
              " tolerance: mismatch 0.5 %, leak 5 %, false_shadow 2 %, missing_edges 5 %\n"
              " within tolerance here, but not for moving-light, moving-casters: sm-history:base=lispsm\n"
              " within tolerance here, but not for open-meshes: volume-zfail\n"
              " not applicable: pcss (needs an area light)\n");
}

TEST(TerminalTable, OfASoftSceneComparesOneMetricAndLeavesOutWhatNoRecordHas) {
    EXPECT_EQ(
        report::terminalTable(softScene(), "overlapping-occluders"),
        " scene: overlapping-occluders · 256² · error = rms error of visibility · cost = standing frames of sm-uniform\n"
        " technique        error     leak   cost   front\n"
        " sm-uniform      0.1900   1.00 %   1.00       ●\n"
        " pcss            0.0312        –   2.94\n"
        " temporal-soft   0.0210        –   2.20       ●\n"
        " truth: exact (polygon); POV-Ray 1024 samples, σ 0.0006\n"
        " tolerance: penumbra_rmse 0.05, umbra_leak 0.05\n"
        " within tolerance here, but not for moving-light, moving-casters: temporal-soft\n");
}

/// The soft scene with the exact errors of its soft rows: the two are put in another order.
std::vector<Record> otherOrder() {
    std::vector<Record> records = softScene();
    records[0].softReference->area = AreaInfo{"a", "b", 0.004, 0.1901};
    records[1].reference->area = AreaInfo{"a", "b", 0.004, 0.0206};
    records[2].reference->area = AreaInfo{"a", "b", 0.004, 0.0209};
    return records;
}

TEST(TerminalTable, ShowsTheErrorAgainstTheExactShareAndWhichRowsItPutsInAnotherOrder) {
    const std::string text = report::terminalTable(otherOrder(), "overlapping-occluders");
    EXPECT_NE(text.find(" technique        error    exact     leak   cost   front\n"
                        " sm-uniform      0.1900   0.1901   1.00 %   1.00       ●\n"
                        " pcss            0.0312   0.0206        –   2.94\n"
                        " temporal-soft   0.0210   0.0209        –   2.20       ●\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find(" cannot be told apart: pcss and temporal-soft (samples of the light order them one way, the exact "
                        "share the other)\n"),
              std::string::npos)
        << text;
}

TEST(Inseparable, AreRowsThatTheExactShareOrdersOtherwiseOfThoseWhereItIsKnown) {
    std::vector<Record> records = otherOrder();
    using Pairs = std::map<std::size_t, std::vector<std::size_t>>;
    EXPECT_EQ(report::inseparable(records, "overlapping-occluders"), (Pairs{{1, {2}}, {2, {1}}}));
    records[2].reference->area->rmse = 0.0206; // equal by one of them: no other order
    EXPECT_EQ(report::inseparable(records, "overlapping-occluders"), Pairs{});
    records[2].reference->area.reset();
    EXPECT_EQ(report::inseparable(records, "overlapping-occluders"), Pairs{});
    EXPECT_EQ(report::inseparable(hardScene(), "dueling-frusta"), Pairs{});
}

TEST(TerminalTable, SaysThatNothingIsWithinToleranceAndNamesErrors) {
    std::vector<Record> records = {hardCell("sm-uniform", 0.0487, 1), unscored(Status::Error, "primary hits differ")};
    EXPECT_EQ(report::terminalTable(records, "dueling-frusta"),
              " scene: dueling-frusta · 256² · error = mismatching pixels · cost = standing frames of sm-uniform\n"
              " technique     error   false shadow     leak   edge error px   flicker   cost   front\n"
              " sm-uniform   4.87 %         0.05 %   0.04 %            0.40    0.0162   1.00       ●\n"
              " truth: exact (polygon)\n"
              " no technique is within tolerance (mismatch 0.5 %, leak 5 %, false_shadow 2 %, missing_edges 5 %)\n"
              " error: sm-history:base=lispsm (primary hits differ)\n");
    EXPECT_EQ(report::terminalTable(records, "no-such-scene"), "");
}

TEST(TerminalTable, OfRecordsWithoutTimesNamesAllThatAreWithinTolerance) {
    std::vector<Record> records = {hardCell("a", 0.001, 1), hardCell("b", 0.01, 1), hardCell("c", 0.004, 1)};
    for (Record& record : records) clear(record, "cost.time");
    const std::string table = report::terminalTable(records, "dueling-frusta");
    EXPECT_NE(table.find(" within tolerance (mismatch 0.5 %, leak 5 %, false_shadow 2 %, missing_edges 5 %), none "
                         "of them timed: a, c\n"),
              std::string::npos)
        << table;
}

TEST(TerminalTable, TellsATinyErrorFromNone) {
    const std::string table = report::terminalTable({hardCell("a", 0.00001, 1), hardCell("b", 0, 1)}, "dueling-frusta");
    EXPECT_NE(table.find("a           < 0.01 %"), std::string::npos) << table;
    EXPECT_NE(table.find("b             0.00 %"), std::string::npos) << table;
}

TEST(MarkdownTable, HasARowARecordAndEscapesWhatMarkdownWouldRead) {
    std::vector<Record> records = {hardCell("a_b|c", 0.01, 1)};
    clear(records[0], "cost");
    clear(records[0], "accuracy");
    records[0].values["accuracy.mismatch"] = 0.01;
    clear(records[0], "stability");
    clear(records[0], "aliasing");
    records[0].figures.clear();
    records[0].passes.clear();
    EXPECT_EQ(report::markdownTable(records, "dueling-frusta"),
              "| technique | error |\n"
              "|:---|---:|\n"
              "| a\\_b\\|c | 1.00 % |\n"
              "\n"
              "truth: exact (polygon)\n"
              "\n"
              "no technique is within tolerance (mismatch 0.5 %, leak 5 %, false\\_shadow 2 %, missing\\_edges 5 %)\n");
}

TEST(MarkdownTable, HasTheColumnsThatDecideAndWhatOnlyTheTechniqueKnows) {
    const std::string table = report::markdownTable({hardCell("sm-uniform", 0.01, 1)}, "dueling-frusta");
    EXPECT_NE(table.find("| technique | error | false shadow | leak | edge error px | flicker | cost | front |\n"),
              std::string::npos)
        << table;
    EXPECT_NE(table.find("| Shadow map, uniform<br><sub>sm-uniform</sub> | 1.00 % |"), std::string::npos) << table;
    const std::string soft = report::markdownTable(otherOrder(), "overlapping-occluders");
    EXPECT_NE(soft.find("| technique | error | exact | penumbra rmse | cost | front |\n"), std::string::npos) << soft;
    EXPECT_NE(table.find("\nfigures of sm-uniform: confident 0.31, tiles 6\n"), std::string::npos) << table;
}

TEST(ParetoFront, HoldsWhatNoOtherRecordBeatsByRisingCost) {
    const std::vector<Record> records = {hardCell("dear", 0, 5), hardCell("beaten", 0.02, 2), hardCell("middle", 0.01, 1.5),
                                         hardCell("cheap", 0.3, 0.3)};
    EXPECT_EQ(variants(records, report::paretoFront(records, "dueling-frusta")),
              (std::vector<std::string>{"cheap", "middle", "dear"}));
}

TEST(ParetoFront, KeepsEqualRecordsAndDropsOnesBeatenInOneOnly) {
    const std::vector<Record> records = {hardCell("twin", 0.1, 1), hardCell("twin:map=2", 0.1, 1),
                                         hardCell("dearer", 0.1, 1.1), hardCell("worse", 0.2, 1)};
    EXPECT_EQ(variants(records, report::paretoFront(records, "dueling-frusta")),
              (std::vector<std::string>{"twin", "twin:map=2"}));
}

TEST(ParetoFront, CountsADifferenceInCostBeyondTheRoundsIntervalsOnly) {
    Record right = hardCell("right", 0.01, 1.02), worse = hardCell("worse", 0.02, 1), cheap = hardCell("cheap", 0.02, 0.8);
    for (Record* record : {&right, &worse, &cheap})
        record->values.list("cost.time.samples") = {20, 20.1, 20.2, 20.3, 20.4, 20.5, 20.6, 20.7, 20.8, 20.9, 21, 21.1};
    EXPECT_EQ(variants({right, worse, cheap}, report::paretoFront({right, worse, cheap}, "dueling-frusta")),
              (std::vector<std::string>{"cheap", "right"}))
        << "2 % are within the interval, a fifth is not";
}

TEST(FrontMark, IsHollowForABaselineAndFarBeyondTheTolerance) {
    const std::vector<Record> records = {hardCell("none", 0.3, 0.3), hardCell("coarse", 0.051, 0.5),
                                         hardCell("fair", 0.049, 0.8), hardCell("beaten", 0.06, 1)}; // tolerance 0.005
    const auto mark = [&](std::size_t i) { return report::frontMark(records, "dueling-frusta", i); };
    EXPECT_EQ(mark(0), "○");
    EXPECT_EQ(mark(1), "○");
    EXPECT_EQ(mark(2), "●");
    EXPECT_EQ(mark(3), "");
}

TEST(ParetoFront, LeavesOutWhatHasNoCostOrNoScoreAndOtherScenes) {
    std::vector<Record> records = hardScene();
    records.push_back(hardCell("untimed", 0, 0.1));
    clear(records.back(), "cost.time");
    records.push_back(softScene()[1]);
    EXPECT_EQ(variants(records, report::paretoFront(records, "dueling-frusta")),
              (std::vector<std::string>{"none", "sm-uniform", "sm-history:base=lispsm", "volume-zfail"}));
    EXPECT_TRUE(report::paretoFront({}, "dueling-frusta").empty());
}

TEST(FrontMark, IsHollowFarBeyondAnyTolerance) {
    std::vector<Record> records = {hardCell("leaky", 0.001, 0.5), hardCell("tight", 0.0001, 1)};
    for (Record& record : records) record.tolerances = {{"leak", 0.05}, {"mismatch", 0.005}};
    records[0].values["accuracy.leak"] = 0.51;
    EXPECT_EQ(report::frontMark(records, "dueling-frusta", 0), "○");
    records[0].values["accuracy.leak"] = 0.49;
    EXPECT_EQ(report::frontMark(records, "dueling-frusta", 0), "●");
}

TEST(Csv, HasOneRowARecordAndTheSameColumnsInEveryRow) {
    const std::string text = report::csv(recordOfEveryStatus());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7);
    const auto commas = [](const std::string& line) { // outside quotes
        bool inside = false;
        return std::count_if(line.begin(), line.end(), [&](char c) {
            inside = inside != (c == '"');
            return c == ',' && !inside;
        });
    };
    std::size_t start = 0;
    const auto columns = commas(text.substr(0, text.find('\n')));
    EXPECT_GT(columns, 60);
    while (start < text.size()) {
        const std::size_t end = text.find('\n', start);
        EXPECT_EQ(commas(text.substr(start, end - start)), columns);
        start = end + 1;
    }
}

TEST(Csv, NamesColumnsByTheirPathAndQuotesWhatNeedsIt) {
    Record record = unscored(Status::Error, "said \"no\", twice");
    const std::string text = report::csv({record});
    EXPECT_EQ(text.find("schema_version,scene,technique,variant,profile,width,height,frames,seed,status,reason,cell,"), 0);
    EXPECT_NE(text.find(",accuracy.edge_error.islands,accuracy.rmse,"), std::string::npos);
    EXPECT_NE(text.find(",error,\"said \"\"no\"\", twice\","), std::string::npos);
    EXPECT_NE(text.find("\"llvmpipe (LLVM 15.0.6, 256 bits)\""), std::string::npos);
}

TEST(Csv, HasModelledFramesOfEveryCardInColumnsOfTheirOwn) {
    Record one = hardRecord(), other = hardRecord();
    one.modelled["gtx-1080@1920x1080"] = {0.75, 0.5, 1.5, false, {}, {}};
    other.modelled["rx-6800-xt@1920x1080"] = {0.25, 0.125, 0.375, true, {}, 2.5};
    const std::string text = report::csv({one, other});
    EXPECT_NE(text.find(",cost.gpu.gtx-1080@1920x1080.milliseconds,cost.gpu.gtx-1080@1920x1080.least,"), std::string::npos);
    EXPECT_NE(text.find(",cost.gpu.rx-6800-xt@1920x1080.motion"), std::string::npos);
    EXPECT_NE(text.find(",0.75,0.5,1.5,"), std::string::npos) << text;
    EXPECT_NE(text.find(",0.25,0.125,0.375,"), std::string::npos) << text;
}

TEST(Csv, LeavesAbsentMetricsEmpty) {
    Record record = hardRecord();
    clear(record, "accuracy");
    record.values["accuracy.mismatch"] = 0.25; // three more columns until …
    record.values["accuracy.leak"] = 0.5;
    EXPECT_NE(report::csv({record}).find(",0.25,,,,0.5,,,,"), std::string::npos) << report::csv({record});
}

} // namespace
} // namespace shadowbench
