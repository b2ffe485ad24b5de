// What a frame costs: the dearer of standing and in motion.
#include "report/advice.h"
#include "report/cost_report.h"
#include "report/run_report.h"
#include "report/summary.h"
#include "report/terminal_summary.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;
using report::frameCost;

/// A record that costs `stands` times sm-uniform's frame where nothing moves, and `moves` times where light and casters do.
Record movingCell(const std::string& variant, double mismatch, double stands, double moves) {
    Record record = hardCell(variant, mismatch, stands);
    record.values["cost.motion.time.median"] = 20 * moves;
    record.values["cost.motion.time.ratio"] = moves;
    record.values.list("cost.motion.time.samples") = {20 * moves};
    const auto standing = metrics::linesOf("cost.work"), moving = metrics::linesOf("cost.motion.work");
    for (std::size_t i = 0; i < moving.size(); ++i) record.values[moving[i]] = record.values[standing[i]];
    return record;
}

/// The same with a cache: in motion it has a pass more.
Record cachingCell(const std::string& variant, double mismatch, double stands, double moves) {
    Record record = movingCell(variant, mismatch, stands, moves);
    record.motionPasses = record.passes;
    record.motionPasses.push_back({.name = "pages", .runs = 64, .fragments = 100, .vertices = 6400, .draws = 64});
    return record;
}

std::vector<Record> scene() {
    return {movingCell("sm-uniform", 0.01, 1, 1), cachingCell("sm-adaptive", 0.004, 1.3, 3.3),
            movingCell("sm-cascaded", 0.004, 2.4, 2.3)};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FrameCost, IsTheDearerOfStandingAndInMotion) {
    EXPECT_DOUBLE_EQ(frameCost(movingCell("a", 0, 1.3, 3.3))->ratio, 3.3);
    EXPECT_DOUBLE_EQ(frameCost(movingCell("a", 0, 2.4, 2.3))->ratio, 2.4);
    EXPECT_DOUBLE_EQ(report::standingCost(movingCell("a", 0, 1.3, 3.3))->ratio, 1.3);
    EXPECT_DOUBLE_EQ(report::place(movingCell("a", 0, 1.3, 3.3))->cost, 3.3);
}

TEST(FrameCost, OfOlderRecordsIsTheStandingFramesAndSaysSo) {
    const Record old = hardCell("sm-adaptive", 0.004, 1.3);
    EXPECT_DOUBLE_EQ(frameCost(old)->ratio, 1.3);
    EXPECT_FALSE(report::knowsMotion(old));
    EXPECT_TRUE(contains(report::terminalTable({old}, old.scene), "cost = standing frames of sm-uniform"));
    std::vector<Record> mixed = scene();
    mixed.push_back(old);
    const std::string table = report::terminalTable(mixed, old.scene);
    EXPECT_TRUE(contains(table, "cost = frames of sm-uniform, the dearer of standing and in motion")) << table;
    EXPECT_TRUE(contains(table, " cost of the standing frame alone: sm-adaptive\n")) << table;
}

TEST(FrameCost, DecidesFrontAndChoice) {
    const std::vector<Record> records = scene(), still = report::standing(scene());
    const std::string& id = records.front().scene;
    EXPECT_EQ(records[*report::adviceFor(records, id).take].variant, "sm-cascaded");
    EXPECT_EQ(still[*report::adviceFor(still, id).take].variant, "sm-adaptive");
    EXPECT_EQ(report::paretoFront(records, id), (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(report::paretoFront(records, id, report::standingCost), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(report::paretoFront(still, id), (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(report::frontMark(records, id, 1), "");
    EXPECT_EQ(report::frontMark(records, id, 1, report::standingCost), "●");
}

TEST(CacheSaves, IsTheQuotientOfWhatDrawsMoreInMotionAndOfNothingElse) {
    EXPECT_NEAR(report::cacheSaves(cachingCell("sm-adaptive", 0.004, 1.3, 3.3)).value(), 3.3 / 1.3, 1e-12);
    EXPECT_FALSE(report::cacheSaves(movingCell("sm-cascaded", 0.004, 2.4, 2.5)));
    Record turned = movingCell("sm-history", 0.004, 1, 1);
    turned.motionPasses = turned.passes;
    turned.motionPasses.front().fragments += 8; // a map that is turned in each frame
    EXPECT_FALSE(report::cacheSaves(turned));
}

TEST(Tables, ShowWhatIsKeptAndBothFronts) {
    const std::string page = report::markdownTable(scene(), scene().front().scene);
    EXPECT_TRUE(contains(page, "| flicker | cost | front |")) << page;
    EXPECT_TRUE(contains(page, "| 3.30 |  |")) << page;
    EXPECT_TRUE(contains(page, "saved while light and casters stand still: sm-adaptive 2.54 ×")) << page;
    const std::string still = report::markdownTable(report::standing(scene()), scene().front().scene);
    EXPECT_TRUE(contains(still, "| 1.30 | ● |")) << still;
}

TEST(PassTables, HaveWhatIsDrawnInMotionBelowTheStandingFrame) {
    const std::vector<Record> records = {cachingCell("sm-adaptive", 0.004, 1.3, 3.3)};
    const std::string table = report::passTable(records, records.front().scene);
    EXPECT_TRUE(contains(table, "|  | pages, in motion | 64 |")) << table;
    EXPECT_FALSE(contains(table, "G-buffer, in motion")) << table;
    EXPECT_TRUE(contains(report::passCsv(records), ",motion,pages,64,,,100,6400,64\n")) << report::passCsv(records);
}

} // namespace
} // namespace shadowbench
