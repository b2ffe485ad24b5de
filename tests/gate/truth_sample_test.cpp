// A wrong truth in the cache, which base and head share, is found by computing it anew.
#include "gate/truth_sample.h"

#include "base/temporary_folder.h"
#include "harness/cells/truths.h"
#include "scene/load/load.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

/// A cache that holds the labels of three frames, which take moments; it lacks the scene's other truths.
class TruthSample : public testing::Test {
protected:
    groundtruth::Reference label(int frame) {
        return groundtruth::cached(cache_, referenceRequest(scene_, Truth::Hard, first_ + frame));
    }
    void spoil(int frame, double seconds = 1) {
        groundtruth::Reference wrong = label(frame);
        wrong.visibility(100, 200) = 1 - wrong.visibility(100, 200);
        wrong.provenance.seconds = seconds;
        cache_.store(wrong);
    }
    [[nodiscard]] std::vector<std::string> found(const std::string& commit = "c0ffee") const {
        return contradictedTruths({{"dueling-frusta", "dueling-frusta", "", "", {}}}, Profile::Gate, folder_.path(), commit,
                                  true);
    }

    TemporaryFolder folder_;
    groundtruth::Cache cache_{folder_.path()};
    Scene scene_ = loadScene("dueling-frusta", Profile::Gate);
    int first_ = scene_.timeline.still - 1;
};

TEST_F(TruthSample, SaysNothingOfRightTruthsAndOfNone) {
    EXPECT_TRUE(found().empty());
    for (const int frame : {0, 1, 2}) label(frame);
    EXPECT_TRUE(found().empty());
}

TEST_F(TruthSample, NamesSceneTruthAndRemedyOfWrongOnes) {
    for (const int frame : {0, 1}) spoil(frame);
    const std::vector<std::string> sentences = found();
    ASSERT_EQ(sentences.size(), 2U);
    for (const char* part : {"the hard truth of dueling-frusta frame ", "is not the one that was kept (1 labels, visibility",
                             "cache prune --all --cache "})
        EXPECT_NE(sentences[0].find(part), std::string::npos) << sentences[0];
}

TEST_F(TruthSample, LeavesOutWhatTakesLong) {
    for (const int frame : {0, 1}) spoil(frame, 3600);
    EXPECT_TRUE(found().empty());
}

TEST_F(TruthSample, LooksAtTwoThatTheCommitDraws) {
    spoil(0);
    for (const int frame : {1, 2}) label(frame);
    std::size_t times = 0;
    for (int commit = 0; commit < 12; ++commit) {
        const std::string name = fmt::format("commit {}", commit);
        times += found(name).size();
        EXPECT_EQ(found(name), found(name));
    }
    EXPECT_GT(times, 0U);
    EXPECT_LT(times, 12U) << "two of three";
}

} // namespace
} // namespace shadowbench::gate
