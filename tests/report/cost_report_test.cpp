#include "base/files.h"
#include "base/temporary_folder.h"
#include "report/cost_report.h"
#include "report/modelled_costs.h"
#include "report/run_report.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<Record> timed() { return {hardCell("sm-uniform", 0.01, 1), hardCell("vsm", 0.02, 3)}; }

std::vector<Record> untimed() {
    std::vector<Record> records = timed();
    for (Record& record : records) {
        record.otherScreen.reset();
        for (PassRecord& pass : record.passes) {
            pass.milliseconds.reset();
            pass.share.reset();
        }
    }
    return records;
}

TEST(PassTable, HasEachPassAndSaysWhatItGrowsWith) {
    const std::string table = report::passTable(timed(), "dueling-frusta");
    EXPECT_TRUE(contains(
        table, "| technique | pass | runs | ms | share | ms at 1024² | fragments | vertices | draws | grows with |\n"))
        << table;
    EXPECT_TRUE(contains(table, "| sm-uniform | G-buffer | 1 | 6.60 | 30.0 % | 6.60 | 32768 | 210 | 2 | screen |\n"))
        << table;
    EXPECT_TRUE(contains(table, "|  | depth map | 2 | 15.40 | 70.0 % | 15.40 | 32768 | 70280 | 1 | map |\n")) << table;
    EXPECT_TRUE(contains(table, "|  | between passes | 1 | 0.00 | 0.00 % | 0.00 | 0 | 0 | 0 | – |\n")) << table;
    EXPECT_TRUE(contains(table, "| vsm | G-buffer |")) << table;
}

TEST(PassTable, IsAbsentWithoutTimes) {
    EXPECT_EQ(report::passTable(untimed(), "dueling-frusta"), "");
    EXPECT_EQ(report::rasteriserNote(untimed(), "dueling-frusta"), "");
    EXPECT_FALSE(report::passChart(untimed(), "dueling-frusta"));
    EXPECT_TRUE(contains(report::passCsv(untimed()), "sm-uniform,gate,256,256,standing,depth map,2,,,32768,70280,1\n"))
        << "work is there";
}

TEST(ModelledTable, SetsPlacesBesideThoseWhereRowsWereMeasured) {
    std::vector<Record> records = timed(); // sm-uniform and vsm, which is dearer here
    EXPECT_EQ(report::modelledTable(records, "dueling-frusta"), "");
    records[0].modelled["h200@800x600"] = {
        4, 2, 8, false, {{"G-buffer", 9, 0, 0, 0, 0, 0}, {"resolve", 1, 3, 2, 0, 0, 0.5}, {"blur", 0.5, 0, 0, 0.25, 0, 0}}};
    records[1].modelled["h200@800x600"] = {3, 2, 8, false, {{"blur", 1, 0.5, 2, 0, 0, 1}}};
    records.push_back(hardCell("sm-tiled", 0.03, 2));
    records[2].modelled["h200@800x600"] = {5, 2, 8, true, {}};
    const std::string table = report::modelledTable(records, "dueling-frusta");
    EXPECT_TRUE(
        contains(table, "| technique | standing here, × (place) | ms on h200 at 800×600 (place) | limited by | × bound |\n"))
        << table;
    const std::size_t vsm = table.find("| vsm | 3.00 (2) | 3.00 (1) | blur: output | 1.00 |\n");
    const std::size_t uniform = table.find("| sm-uniform | 1.00 (1) | 4.00 (2) | resolve: texture | 1.07 |\n");
    EXPECT_LT(vsm, uniform) << table;
    EXPECT_NE(uniform, std::string::npos) << table;
    EXPECT_TRUE(contains(table, "| sm-tiled | 2.00 | – | waits for the program | – |\n")) << table;
}

TEST(DeviceTable, SetsWholeFramesOnAGraphicsProcessorBesideEachOther) {
    const std::vector<Record> records{deviceRecord()};
    const std::string table = report::deviceTable(records, "dueling-frusta");
    EXPECT_TRUE(contains(table, "| ms at 1024² | × base at 1024² | in motion at 1024² | first at 1024² |")) << table;
    EXPECT_TRUE(contains(table, "| 1.20 | 1.10 | 1.50 | 1.30 | 0.04 | 4.80 | 1.10 | 6.00 | – | 0.04 |\n")) << table;
    EXPECT_EQ(report::deviceTable(timed(), "dueling-frusta"), "");
}

TEST(DeviceTable, HasPassesOfTheLargerImagesBelowIt) {
    const std::vector<Record> records{deviceRecord()};
    const std::string table = report::passTable(records, "dueling-frusta");
    EXPECT_TRUE(
        contains(table, "| sm-history:base=lispsm | G-buffer | 1 | 6.60 | 30.0 % | 6.60 | 32768 | 210 | 2 | screen |"))
        << table;
    EXPECT_TRUE(
        contains(report::passCsv(records), "sm-history:base=lispsm,gate,2048,2048,standing,G-buffer,1,6.6,0.3,131072,"))
        << report::passCsv(records);
    EXPECT_TRUE(report::passChart(records, "dueling-frusta"));
    EXPECT_TRUE(contains(report::rasteriserNote(records, "dueling-frusta"), "H200")) << "names the processor";
    EXPECT_FALSE(contains(report::rasteriserNote(records, "dueling-frusta"), "llvmpipe"));
}

TEST(RasteriserNote, SaysWhatDrewAndWhatThatDoesToTimes) {
    std::vector<Record> records = timed();
    const std::string software = report::rasteriserNote(records, "dueling-frusta");
    EXPECT_TRUE(contains(software, "llvmpipe (LLVM 15.0.6, 256 bits), on the calling thread alone")) << software;
    EXPECT_TRUE(contains(software, "shades 8 pixels at a time and pays for both sides of every `if`")) << software;
    for (Record& record : records) {
        record.environment.rasterThreads = 4;
        record.environment.vectorBits = 128;
    }
    const std::string four = report::rasteriserNote(records, "dueling-frusta");
    EXPECT_TRUE(contains(four, "with 4 raster threads") && contains(four, "shades 4 pixels")) << four;
    for (Record& record : records) record.environment.renderer = "some GPU";
    EXPECT_EQ(report::rasteriserNote(records, "dueling-frusta"), "Times are of some GPU, with 4 raster threads.");
    for (Record& record : records) {
        record.environment.vectorBits = record.environment.rasterThreads = 0;
        record.environment.driver = "NVIDIA 550.54.15";
    }
    EXPECT_EQ(report::rasteriserNote(records, "dueling-frusta"),
              "Times are of some GPU, NVIDIA 550.54.15, by its own clock.");
    records = {deviceRecord()};
    EXPECT_TRUE(contains(report::rasteriserNote(records, "dueling-frusta"),
                         ", by its own clock, on images of 1024² and 2048² pixels; costs are those of the first."));
}

TEST(PassCsv, HasOneRowAPassOnEachScreen) {
    const std::string text = report::passCsv(timed());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 2 * (3 + 3));
    EXPECT_TRUE(contains(text, "\ndueling-frusta,sm-uniform,gate,256,256,standing,depth map,2,15.4,0.7,32768,70280,1\n"))
        << text;
    EXPECT_TRUE(contains(text, ",1024,1024,standing,G-buffer,1,6.6,0.3,524288,210,2\n")) << text;
    EXPECT_EQ(report::passCsv({unscored(Status::Error, "x")}), "");
}

TEST(PassChart, HasABarARecordAndNamesItsPasses) {
    const auto svg = report::passChart(timed(), "dueling-frusta");
    ASSERT_TRUE(svg);
    for (const char* text : {"sm-uniform", "vsm", "G-buffer", "depth map", "ms a frame", ">22<"})
        EXPECT_TRUE(contains(*svg, text)) << text;
    EXPECT_EQ(svg, report::passChart(timed(), "dueling-frusta")) << "the same bytes";
}

TEST(PassChart, CutsABarThatWouldLeaveNoLengthToOthers) {
    std::vector<Record> records = timed();
    records.push_back(hardCell("sm-focused", 0.01, 1));
    records[1].passes[1].milliseconds = 4000;
    EXPECT_TRUE(contains(report::passChart(records, "dueling-frusta").value(), "› 4.01e+03"));
}

TEST(ReportOfCosts, IsAPageAndATableOfItsOwn) {
    const TemporaryFolder folder;
    report::writeReport(timed(), folder.path());
    const std::string page = readFile(folder.path() / "report.md");
    EXPECT_TRUE(contains(page, "[costs.md](costs.md)"));
    EXPECT_TRUE(contains(page, "![passes-dueling-frusta](passes-dueling-frusta.svg)"));
    EXPECT_TRUE(contains(page, "Times are of llvmpipe"));
    const std::string costs = readFile(folder.path() / "costs.md");
    EXPECT_TRUE(contains(costs, "## dueling-frusta\n\n256² pixels. Times are of llvmpipe")) << costs;
    EXPECT_EQ(readFile(folder.path() / "passes.csv"), report::passCsv(timed()));
}

} // namespace
} // namespace shadowbench
