// In what costs are shown: modelled where records have it, else measured here.
#include "report/costing.h"

#include "report/advice.h"
#include "report/run_report.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using namespace test;

constexpr const char* card = "gtx-1080@1920x1080";

/// Its cost as measured here, and milliseconds on the card, in motion others.
Record modelledCell(const std::string& variant, double mismatch, double ratio, double milliseconds,
                    std::optional<double> motion = {}) {
    Record record = hardCell(variant, mismatch, ratio);
    record.modelled[card] = {milliseconds, milliseconds / 2, 2 * milliseconds, false, {}, motion};
    return record;
}

TEST(Costing, IsMeasuredHereWhereNothingIsModelled) {
    const std::vector<Record> records = hardScene();
    const report::Costing costing = report::shownCosting(records, records.front().scene);
    EXPECT_EQ(costing.card, "");
    EXPECT_EQ(costing.unit, "×");
    EXPECT_EQ(report::chartName(costing), "pareto");
    EXPECT_EQ(costing.of(records[1])->ratio, report::frameCost(records[1])->ratio);
}

TEST(Costing, ModelledIsTheDearerOfStandingAndInMotion) {
    const Record kept = modelledCell("sm-adaptive", 0.004, 1.3, 0.5, 3.0), still = modelledCell("pcf", 0.1, 1, 2.0, 1.5);
    const report::Costing costing = report::shownCosting({kept}, kept.scene);
    EXPECT_EQ(costing.card, card);
    EXPECT_EQ(report::chartName(costing), "modelled-gtx-1080-1920x1080");
    EXPECT_EQ(costing.meaning, "ms on gtx-1080 at 1920×1080, modelled: the dearer of standing and in motion");
    EXPECT_EQ(costing.of(kept)->ratio, 3.0);
    EXPECT_EQ(costing.standing(kept)->ratio, 0.5);
    EXPECT_EQ(costing.of(still)->ratio, 2.0);
    EXPECT_EQ(costing.of(report::standing({kept}).front())->ratio, 0.5);
}

TEST(Costing, HasNoneOfRowsThatWaitOrAreNotModelled) {
    Record waits = modelledCell("sm-tiled", 0.004, 1.3, 0.5);
    waits.modelled[card].waits = true;
    const report::Costing costing = report::modelledOn(card);
    EXPECT_FALSE(costing.of(waits));
    EXPECT_FALSE(costing.standing(waits));
    EXPECT_FALSE(costing.of(hardCell("pcf", 0.1, 1)));
}

TEST(Costing, DecidesFrontAndAdvice) {
    // Cheap on a rasteriser of this machine and dear on the card, and the other way round.
    const std::vector<Record> records{modelledCell("sm-cascaded", 0.001, 1.2, 4), modelledCell("sm-lispsm", 0.001, 2.4, 0.8),
                                      modelledCell("sm-psm", 0.001, 2.5, 0.81)};
    const std::string& scene = records.front().scene;
    const report::CostOf costOf = report::shownCosting(records, scene).of;
    EXPECT_EQ(report::paretoFront(records, scene), std::vector<std::size_t>{0});
    EXPECT_EQ(report::paretoFront(records, scene, costOf), std::vector<std::size_t>{1});
    const report::Advice advice = report::adviceFor(records, scene);
    EXPECT_EQ(advice.take, 1U);
    EXPECT_EQ(advice.asCheap, std::vector<std::size_t>{2});
}

TEST(Costing, OfSeveralScenesIsModelledWhereAllAreOnOneCard) {
    std::vector<Record> records{modelledCell("sm-cascaded", 0.001, 1.2, 4), modelledCell("sm-lispsm", 0.001, 2.4, 0.8)};
    for (std::size_t i = 0; i < 2; ++i) {
        records.push_back(records[i]);
        records.back().scene = "b";
    }
    const std::string a = records.front().scene;
    EXPECT_EQ(report::commonAdvice(records, {a, "b"})->variant, "sm-lispsm");
    EXPECT_EQ(report::commonAdvice(records, {a, "b"})->card, card);
    for (std::size_t i = 2; i < 4; ++i) records[i].modelled.clear();
    EXPECT_EQ(report::commonAdvice(records, {a, "b"})->variant, "sm-cascaded");
    EXPECT_EQ(report::commonAdvice(records, {a, "b"})->card, "");
}

TEST(Costing, IsAColumnOfTables) {
    const std::vector<Record> records{modelledCell("sm-cascaded", 0.001, 1.2, 4, 4.5)};
    const std::string table = report::terminalTable(records, records.front().scene);
    EXPECT_NE(table.find("modelled ms"), std::string::npos) << table;
    EXPECT_NE(table.find("4.500"), std::string::npos) << table;
    EXPECT_EQ(report::terminalTable(hardScene(), "dueling-frusta").find("modelled ms"), std::string::npos);
}

} // namespace
} // namespace shadowbench
