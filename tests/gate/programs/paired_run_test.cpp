// Turns of two programs: how long they are, which workers share them, and what their samples come to.
#include "gate/paired_run.h"

#include "base/temporary_folder.h"
#include "tests/gate/programs/stand_in.h"

#include <cmath>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

PairedSamples samplesOf(double head, double headWall, double controlWall) {
    const std::vector<PairedRound> rounds(20, PairedRound{{100, 100}, {head, headWall}, {100, controlWall}});
    return {1, std::vector(24, rounds)};
}

class TurnsOfStandIns : public testing::Test {
protected:
    TurnsOfStandIns() { options_.restarts = 1; }
    [[nodiscard]] std::vector<TimeJudgement> judged(const std::vector<TimedCell>& cells,
                                                    const Progress& progress = {}) const {
        return judgePairedTime(base_.program(), head_.program(), cells, options_, progress);
    }

    TemporaryFolder folder_;
    StandIn base_{folder_.path(), "base"}, head_{folder_.path(), "head"};
    PairedOptions options_;
};

TEST_F(TurnsOfStandIns, CellsOfOneSceneShareTheirWorkers) {
    for (const StandIn* standIn : {&base_, &head_}) standIn->takes("100", "100");
    std::vector<std::string> shown;
    const auto judgements = judged({{"simple", "pcf"}, {"trees", "pcf"}, {"simple", "none"}},
                                   [&](double, std::string_view what) { shown.emplace_back(what); });
    ASSERT_EQ(judgements.size(), 3U);
    EXPECT_EQ(judgements[2].cell.variant, "none");
    EXPECT_EQ(shown, (std::vector<std::string>{"pcf", "none", "pcf"})) << "scene by scene";
    EXPECT_EQ(base_.calls("time-frames"), 4) << "the base and the control, of two scenes";
    EXPECT_EQ(head_.calls("time-frames"), 2);
}

TEST_F(TurnsOfStandIns, ShortFramesMakeATurnTogetherUpToSixteen) {
    for (const StandIn* standIn : {&base_, &head_}) standIn->takes("1", "1");
    EXPECT_EQ(judged({{"simple", "pcf"}})[0].samples.framesPerTurn, 4);
    for (const StandIn* standIn : {&base_, &head_})
        standIn->does("time-frames", "while read -r count variant; do echo 0.001 0.001; done\nexit\n");
    EXPECT_EQ(judged({{"simple", "pcf"}})[0].samples.framesPerTurn, 16);
}

TEST(PairedSamples, ThatAreNoneAreNeverEnough) {
    EXPECT_FALSE(enough({}, {}, 1));
    EXPECT_EQ(judgeTime({}, {}, 1, 1), TimeVerdict::Unclear);
}

TEST(PairedSamples, CountTwoRoundsAsOneAndWithoutWhatAllThreeShare) {
    const auto round = [](double machine, double head) {
        const timing::FrameTime equal{std::exp(machine), 1}, other{std::exp(machine + head), 1};
        return PairedRound{equal, other, equal};
    };
    // The head lies 0, 0 and 6 above the others and so 0, 0 and 4 above the mean of the three: of 0, 0, 0, 2, 2 and 4, the
    // median of the means of pairs is 1; of the others it is −½.
    const std::vector<RestartTimes> times = restartTimes(
        {1, {{round(3, 0), round(-5, 0), round(0, 0), round(1, 0), round(2, 6), round(-1, 6)}}}, &timing::FrameTime::cpu);
    ASSERT_EQ(times.size(), 1U);
    EXPECT_NEAR(times[0].base, -0.5, 1e-12);
    EXPECT_NEAR(times[0].head, 1, 1e-12);
    EXPECT_NEAR(times[0].control, -0.5, 1e-12);
}

TEST(PairedSamples, SayThatAHeadWaitsOnlyWhereEqualProgramsDoNot) {
    const TimedCell cell{"simple", "pcf"};
    EXPECT_TRUE(judgeSamples(cell, samplesOf(100, 120, 100), {}, 1).waits);
    EXPECT_FALSE(judgeSamples(cell, samplesOf(100, 120, 120), {}, 1).waits) << "so does the control";
    EXPECT_FALSE(judgeSamples(cell, samplesOf(100, 104, 100), {}, 1).waits) << "under the floor of wall time";
    EXPECT_FALSE(judgeSamples(cell, samplesOf(120, 120, 100), {}, 1).waits) << "it computes";
}

} // namespace
} // namespace shadowbench::gate
