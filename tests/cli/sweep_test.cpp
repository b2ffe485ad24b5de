// `shadowbench sweep` as a user runs it.
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class Sweep : public testing::Test {
protected:
    [[nodiscard]] Outcome sweep(const std::string& options) const {
        return shell("shadowbench sweep --quiet --scene " + scene_ + " --out " + folder_ / "out" + " --cache " +
                     folder_.cache() + " " + options);
    }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(folder_ / "out/sweep.jsonl"); }

    Folder folder_;
    std::string scene_ = folder_.write(
        "tiny.toml", tinyScene("{ kind = \"point\", centre = [1.7, 6.1, -2.3] }", "[tolerance]\nmismatch = 0.01\n"));
};

TEST_F(Sweep, OfAParameterCurvesAreNamedByTheRestOfTheVariant) {
    const Outcome outcome = sweep("--axis map --values 512,16 --technique sm-uniform --technique volume-zfail");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Record> all = records();
    ASSERT_EQ(all.size(), 2U); // volume-zfail has no map
    EXPECT_EQ(all[0].variant, "sm-uniform:map=512");
    EXPECT_EQ(all[1].variant, "sm-uniform:map=16");
    EXPECT_EQ(all[0].sweep->curve, "sm-uniform");
    EXPECT_LT(*all[0].values["accuracy.mismatch"], 0.01);
    EXPECT_GT(*all[1].values["accuracy.mismatch"], 0.01);
    EXPECT_EQ(all[0].sweep->breakPoint, 16);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/sweep.svg"));
    EXPECT_NE(outcome.output.find("| sm-uniform |"), std::string::npos) << outcome.output;
}

TEST_F(Sweep, OfASceneMovesTheSceneAndTheTruthWithIt) {
    const Outcome outcome = sweep("--axis light-view-angle --values 0,90 --technique none --technique volume-zfail");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Record> all = records();
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[0].variant, "none");
    // A light beside the eye hides most of its shadows; nearer than the eye, not all of them.
    EXPECT_LT(*all[0].values["accuracy.mismatch"], 0.5 * *all[1].values["accuracy.mismatch"]);
    EXPECT_EQ(*all[2].values["accuracy.mismatch_off_edge"], 0);
    EXPECT_EQ(*all[3].values["accuracy.mismatch_off_edge"], 0);
    EXPECT_NE(all[0].reference->key, all[1].reference->key);
}

TEST_F(Sweep, AValueThatOneTechniqueDoesNotTakeIsReportedInItsRecord) {
    const Outcome outcome = sweep("--axis map --values 2048,256 --technique sm-uniform --technique deep-sm");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Record> all = records();
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[0].status, Status::Scored);
    EXPECT_EQ(all[2].status, Status::NotApplicable); // deep-sm has at most 1,024
    EXPECT_NE(all[2].reason.find("16…1024"), std::string::npos) << all[2].reason;
    EXPECT_EQ(all[3].status, Status::Scored);
}

TEST_F(Sweep, ParametersThatExcludeEachOtherAtAValueAreReportedInItsRecord) {
    const Outcome outcome = sweep("--axis map --values 256,64 --technique sm-uniform --technique sm-adaptive");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const std::vector<Record> all = records();
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[2].status, Status::Scored);
    EXPECT_EQ(all[3].status, Status::NotApplicable); // a page has 128² texels
    EXPECT_NE(all[3].reason.find("does not fit into a map of 64²"), std::string::npos) << all[3].reason;
}

TEST_F(Sweep, WrongArgumentsAreRejectedBeforeAnythingIsWritten) {
    EXPECT_EQ(sweep("--axis light-view-angel").code, 2);
    EXPECT_EQ(sweep("--axis map --technique none").code, 2);
    EXPECT_EQ(sweep("--axis map --values 0.5 --technique sm-uniform").code, 2);
    EXPECT_EQ(sweep("--axis map --values 2048 --technique deep-sm").code, 2);
    EXPECT_EQ(sweep("--axis light-size").code, 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

} // namespace
} // namespace shadowbench
