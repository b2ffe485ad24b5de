// Levels of detail as a user runs them.
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class LodRun : public testing::Test {
protected:
    Folder folder_;
    std::string scene_ = folder_.write("walk.toml", walkScene());
    std::string out_ = folder_ / "out";
    std::string tail_ = " --quiet --out " + out_ + " --cache " + folder_.cache();
};

TEST_F(LodRun, ScoresPicturesBesideShadowsAndKeepsTheTablesApart) {
    const Outcome run =
        shell("shadowbench run --scene " + scene_ + " --technique none --technique 'lod-*' --images" + tail_);
    ASSERT_EQ(run.code, 0) << run.output;
    EXPECT_NE(run.output.find("levels of detail: walk · 48² · 5 frames"), std::string::npos) << run.output;
    const std::vector<Record> records = readRecords(out_ + "/results.jsonl");
    ASSERT_EQ(records.size(), 8U); // none, and seven variants
    EXPECT_FALSE(isLevelOfDetail(records[0]));
    for (std::size_t i = 1; i < records.size(); ++i) {
        ASSERT_TRUE(isLevelOfDetail(records[i])) << records[i].variant;
        EXPECT_EQ(records[i].frames, 5);
        EXPECT_EQ(records[i].values.list("lod.by_frame.pop").size(), 4U);
        EXPECT_TRUE(records[i].values["lod.time.median"].has_value());
    }
    EXPECT_TRUE(std::filesystem::exists(out_ + "/images/walk/lod-blend/frame.png"));
    EXPECT_TRUE(std::filesystem::exists(out_ + "/images/walk/lod-blend/transition.png"));
    EXPECT_TRUE(std::filesystem::exists(out_ + "/lod-walk.svg"));
    const std::string page = (std::ostringstream() << std::ifstream(out_ + "/report.md").rdbuf()).str();
    EXPECT_NE(page.find("images/walk/lod-blend/transition.png"), std::string::npos);
}

TEST_F(LodRun, TwiceTheSameGivesTheSameScores) {
    const auto lines = [&] {
        const std::string command = "shadowbench run --cost none --scene " + scene_ + " --technique 'lod-*'" + tail_;
        EXPECT_EQ(shell(command).code, 0);
        std::vector<std::string> result;
        for (Record record : readRecords(out_ + "/results.jsonl")) {
            record.time.clear();
            result.push_back(toJson(record));
        }
        return result;
    };
    const auto first = lines();
    EXPECT_EQ(lines(), first);
}

TEST_F(LodRun, ASceneWithoutAWalkDoesNotApply) {
    const std::string still = folder_.write("still.toml", tinyScene());
    ASSERT_EQ(shell("shadowbench run --scene " + still + " --technique lod-switch" + tail_).code, 2) << "nothing to score";
    const std::vector<Record> records = readRecords(out_ + "/results.jsonl");
    EXPECT_EQ(records[0].status, Status::NotApplicable);
    EXPECT_NE(records[0].reason.find("has no [lod]"), std::string::npos);
    EXPECT_EQ(shell("shadowbench sweep --axis viewport --scene " + still + tail_).code, 2);
}

TEST_F(LodRun, TheViewportIsSwept) {
    const std::string command = "shadowbench sweep --axis viewport --scene " + scene_ + " --technique 'lod-[bs]*'" + tail_;
    const Outcome sweep = shell(command + " --values 32,64");
    ASSERT_EQ(sweep.code, 0) << sweep.output;
    EXPECT_NE(sweep.output.find("| ms a frame | 32² | 64² |"), std::string::npos) << sweep.output;
    const std::vector<Record> records = readRecords(out_ + "/sweep.jsonl");
    ASSERT_EQ(records.size(), 4U); // two techniques, two sizes
    EXPECT_EQ(records[1].sweep->value, 64);
    EXPECT_EQ(records[1].width, 64);
    EXPECT_TRUE(std::filesystem::exists(out_ + "/sweep.svg"));
    EXPECT_EQ(shell(command + " --values 2.5").code, 2);
    EXPECT_EQ(shell("shadowbench sweep --axis viewport --scene " + scene_ + " --technique sm-uniform" + tail_).code, 2);
}

} // namespace
} // namespace shadowbench
