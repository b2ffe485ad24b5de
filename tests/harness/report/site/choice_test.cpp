#include "harness/report/site/choice.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench::site {
namespace {

using namespace test;

std::vector<Record> sceneWithin(double tolerance) {
    std::vector<Record> records = hardScene();
    for (Record& record : records) record.tolerances = {{"mismatch", tolerance}};
    return records;
}

TEST(Choice, IsTheCheapestWithinTolerance) {
    const std::vector<Record> records = sceneWithin(0.005);
    const Choice choice = choiceFor(records, records.front().scene);
    ASSERT_TRUE(choice.take);
    EXPECT_EQ(records[*choice.take].variant, "sm-history:base=lispsm");
    EXPECT_TRUE(choice.adequate);
    EXPECT_EQ(choice.why, "cheapest of 2 within tolerance");
    ASSERT_EQ(choice.others.size(), 1U);
    EXPECT_EQ(records[choice.others[0]].variant, "volume-zfail");
}

TEST(Choice, IsNeverWhatDrawsNoShadow) {
    const std::vector<Record> records = sceneWithin(0.5); // "none" is within it and the cheapest of all
    EXPECT_EQ(records[*choiceFor(records, records.front().scene).take].variant, "sm-uniform");
}

TEST(Choice, IsTheNearestWhereNoneIsWithinAndSaysSo) {
    std::vector<Record> records = sceneWithin(0.0001);
    std::erase_if(records, [](const Record& record) { return record.variant == "volume-zfail"; });
    const Choice choice = choiceFor(records, records.front().scene);
    EXPECT_EQ(records[*choice.take].variant, "sm-history:base=lispsm");
    EXPECT_FALSE(choice.adequate);
    EXPECT_EQ(choice.why, "none is within tolerance; this one is nearest");
}

TEST(Choice, IsTheLeastErrorWithoutTimesAndWithoutTolerances) {
    std::vector<Record> records = sceneWithin(0.005);
    for (Record& record : records) clear(record, "cost.time");
    const Choice untimed = choiceFor(records, records.front().scene);
    EXPECT_EQ(records[*untimed.take].variant, "volume-zfail");
    EXPECT_EQ(untimed.why, "least error of 2 within tolerance; none was timed");
    for (Record& record : records) record.tolerances.clear();
    EXPECT_EQ(choiceFor(records, records.front().scene).why, "least error; the scene states no tolerance");
    EXPECT_FALSE(choiceFor({records.back()}, records.front().scene).take); // not applicable
}

} // namespace
} // namespace shadowbench::site
