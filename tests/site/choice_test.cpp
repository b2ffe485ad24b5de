#include "site/choice.h"
#include "tests/support/report_examples.h"

#include <gtest/gtest.h>

namespace shadowbench::site {
namespace {

using namespace test;

/// Two that may be within a tolerance, beside `none` and sm-uniform: sm-tsm is cheaper, sm-alias-free is right.
std::vector<Record> sceneWithin(double tolerance) {
    std::vector<Record> records = hardScene();
    records[2].variant = records[2].technique = "sm-tsm";
    records[3].variant = records[3].technique = "sm-alias-free";
    for (Record& record : records) record.tolerances = {{"mismatch", tolerance}};
    return records;
}

TEST(Choice, IsTheCheapestWithinTolerance) {
    const std::vector<Record> records = sceneWithin(0.005);
    const Choice choice = choiceFor(records, records.front().scene);
    ASSERT_TRUE(choice.take);
    EXPECT_EQ(records[*choice.take].variant, "sm-tsm");
    EXPECT_TRUE(choice.adequate);
    EXPECT_EQ(choice.why, "cheapest of 2 within tolerance");
    ASSERT_EQ(choice.others.size(), 1U);
    EXPECT_EQ(records[choice.others[0]].variant, "sm-alias-free");
}

TEST(Choice, SaysWhereAFrameHasNoTimeForIt) {
    std::vector<Record> records = sceneWithin(0.005);
    for (const double milliseconds : {16.0, 17.0}) {
        for (Record& record : records)
            record.modelled["gtx-1080@1920x1080"] = {milliseconds, milliseconds, milliseconds, false, {}, {}};
        records[3].modelled["gtx-1080@1920x1080"].milliseconds = 200;
        const Choice choice = choiceFor(records, records.front().scene);
        const bool fits = milliseconds < 1000.0 / 60;
        EXPECT_EQ(choice.why, fits ? "cheapest of 2 within tolerance"
                                   : "cheapest of 2 within tolerance, of which none is modelled to fit a frame at 60 Hz");
        EXPECT_EQ(choice.notes.empty(), fits);
    }
}

TEST(Choice, IsNeverWhatDrawsNoShadow) {
    const std::vector<Record> records = sceneWithin(0.5); // "none" is within it and the cheapest of all
    EXPECT_EQ(records[*choiceFor(records, records.front().scene).take].variant, "sm-uniform");
}

TEST(Choice, IsTheNearestWhereNoneIsWithinAndSaysSo) {
    std::vector<Record> records = sceneWithin(0.0001);
    std::erase_if(records, [](const Record& record) { return record.variant == "sm-alias-free"; });
    const Choice choice = choiceFor(records, records.front().scene);
    EXPECT_EQ(records[*choice.take].variant, "sm-tsm");
    EXPECT_FALSE(choice.adequate);
    EXPECT_EQ(choice.why, "none is within tolerance; this one is nearest");
}

TEST(Choice, IsTheLeastErrorWithoutTimes) {
    std::vector<Record> records = sceneWithin(0.005);
    for (Record& record : records) clear(record, "cost.time");
    const Choice untimed = choiceFor(records, records.front().scene);
    EXPECT_EQ(records[*untimed.take].variant, "sm-alias-free");
    EXPECT_EQ(untimed.why, "least error of 2 within tolerance; none was timed");
    EXPECT_FALSE(choiceFor({records.back()}, records.front().scene).take); // not applicable
}

TEST(Choice, IsNothingThatLacksWhatIsUsuallyNeeded) {
    std::vector<Record> records = sceneWithin(0.005);
    records[2].variant = records[2].technique = "planar-hard";
    const Choice choice = choiceFor(records, records.front().scene);
    EXPECT_EQ(records[*choice.take].variant, "sm-alias-free");
    EXPECT_EQ(choice.notes, std::vector<std::string>{"within tolerance here, but not for any-receiver: planar-hard"});
    const Choice none = choiceFor({records[2]}, records.front().scene);
    EXPECT_FALSE(none.take);
    EXPECT_EQ(none.why, "no technique that can do what is usually needed was scored");
}

} // namespace
} // namespace shadowbench::site
