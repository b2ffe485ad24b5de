// Rows that no method can mean are marked, and the published ones are explained.
#include "report/doubts.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace shadowbench::report {
namespace {

Record scored(double timesNone) {
    Record record;
    record.values["sanity.times_none"] = timesNone;
    return record;
}

TEST(Doubts, HaveARowThatIsWorseThanNoShadowAndNoOther) {
    EXPECT_TRUE(doubts(scored(0.3)).empty());
    EXPECT_TRUE(doubts(scored(1)).empty()); // of `none` itself
    ASSERT_EQ(doubts(scored(1.684)).size(), 1U);
    EXPECT_EQ(doubts(scored(1.684)).front().says, "worse than no shadow: 1.68 times its error");
    EXPECT_EQ(unexplainedDoubts(scored(1.684)), "worse than no shadow: 1.68 times its error");
}

TEST(Doubts, HaveAnErrorThatStandsOnSingleTexelsOrPixels) {
    Record record = scored(0.3);
    record.values["sanity.map_step"] = 2;
    record.values["sanity.image_step"] = 1.9;
    EXPECT_TRUE(doubts(record).empty());
    record.values["sanity.map_step"] = 17.4;
    record.values["sanity.image_step"] = 2.5;
    EXPECT_EQ(unexplainedDoubts(record),
              "a map a fortieth larger changes the error by a factor of 17.4; an image a fortieth "
              "larger changes the error by a factor of 2.5");
}

TEST(Doubts, AreExplainedByWhatTheSceneExpects) {
    Record record = scored(3);
    record.status = Status::ExpectedFailure;
    record.reason = "mismatch is expected to lie above 0.5: the eye is inside a volume";
    ASSERT_EQ(doubts(record).size(), 1U);
    EXPECT_EQ(unexplainedDoubts(record), "");
    record.values["sanity.map_step"] = 4; // of which nothing is said
    EXPECT_EQ(unexplainedDoubts(record), "a map a fortieth larger changes the error by a factor of 4");
    record.reason += "; map_step is expected to lie above 2: one texel decides";
    EXPECT_EQ(unexplainedDoubts(record), "");
}

TEST(Doubts, HasNoRowThatWasNotScored) {
    Record record = scored(3);
    record.status = Status::Error;
    EXPECT_TRUE(doubts(record).empty());
}

TEST(PublishedRecords, HaveNoUnexplainedDoubt) {
    for (const char* set : {"published", "failures", "levels"}) {
        const auto file = std::filesystem::path(SOURCE_FOLDER) / "results" / set / "results.jsonl";
        for (const Record& record : readRecords(file)) {
            EXPECT_EQ(unexplainedDoubts(record), "") << record.variant << " on " << record.scene << " in " << file;
            if (!wasScored(record.status) || isLevelOfDetail(record)) continue;
            for (const char* path : {"sanity.times_none", "sanity.image_step"})
                EXPECT_TRUE(record.values[*metrics::metricAt(path)])
                    << path << " of " << record.variant << " on " << record.scene;
        }
    }
}

} // namespace
} // namespace shadowbench::report
