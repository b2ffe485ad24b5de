// What is published of level-of-detail techniques.
#include "report/lod_report.h"
#include "report/run_report.h"
#include "tests/support/records_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

TEST(LodTable, HasALineARecordAndKeepsApartFromShadows) {
    Record shadow = hardRecord();
    shadow.scene = "windmills";
    const std::vector<Record> records{shadow, lodRecord()};
    EXPECT_EQ(report::lodTerminalTable(records, "windmills"),
              " levels of detail: windmills · 256² · 68 frames, up to 19 instances in transition · pop in 1/1000 · cost = "
              "frames of lod-switch\n"
              " technique                           pop   region px   colour error     noise   order error   primitives   "
              "change   cost\n"
              " lod-frame-sequential:vis=checker   1.10          41         0.0640   -0.0030        0.0000         8694   "
              "1.90 %   1.10\n");
    EXPECT_EQ(report::terminalTable(records, "windmills").find("lod-"), std::string::npos);
    EXPECT_EQ(report::lodTerminalTable({shadow}, "windmills"), "");
    EXPECT_EQ(report::lodMarkdownTable({shadow}, "windmills"), "");
    EXPECT_NE(report::lodMarkdownTable(records, "windmills").find("| 4.0 |"), std::string::npos); // MiB
}

TEST(LodChart, IsThereWhereARecordHasCurves) {
    EXPECT_TRUE(report::lodChart({lodRecord()}, "windmills").has_value());
    EXPECT_FALSE(report::lodChart({hardRecord()}, "dueling-frusta").has_value());
}

TEST(ViewportTable, HasTimesRatiosAndTheCountersThatExplainThem) {
    std::vector<Record> records(2, lodRecord());
    records[0].sweep = SweepStep{"viewport", "pixels", "lod-blend", 128, {}};
    records[1].sweep = SweepStep{"viewport", "pixels", "lod-blend", 512, {}};
    records[1].values["lod.time.median"] = 9;
    records[1].values["lod.time.ratio"] = 2.5;
    const std::string table = report::viewportTable(records);
    EXPECT_NE(table.find("| ms a frame | 128² | 512² |"), std::string::npos) << table;
    EXPECT_NE(table.find("| lod-blend | 4.50 | 9.00 |"), std::string::npos);
    EXPECT_NE(table.find("| lod-blend | 1.10 | 2.50 |"), std::string::npos);
    EXPECT_NE(table.find("| lod-blend | 65536 | 65536 |"), std::string::npos); // fragments
    EXPECT_NE(report::viewportChart(records).find("<svg"), std::string::npos);
    EXPECT_EQ(report::lodTerminalTable(records, "windmills"), ""); // a sweep is no run
}

} // namespace
} // namespace shadowbench
