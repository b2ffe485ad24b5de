// What a gate says of the times of stand-ins.
#include "tests/gate/programs/gate_of_stand_ins.h"

#include <gtest/gtest.h>
#include <utility>

namespace shadowbench::gate {
namespace {

/// Shell: `start` counts the calls from 1 on, of which several may be at once.
const std::string countStarts = "start=1\nwhile ! mkdir \"$here/start-$start\" 2>/dev/null; do start=$((start + 1)); done\n";

/// Shell: `first` is 1 for the call that began first of two which run at once. The second may come first to the line that it
/// waits in, but its process has the greater number.
const std::string orderPairs = "touch \"$here/call-$$\"\n"
                               "calls() { ls \"$here\" | sed -n 's/^call-//p'; }\n"
                               "while [ $(($(calls | wc -l) % 2)) = 1 ]; do sleep 0.01; done\n"
                               "first=$(($(calls | sort -n | tail -n 2 | head -n 1) == $$))\n";

class TimeOfStandIns : public GateOfStandIns {
protected:
    TimeOfStandIns() { options_.time = true; }

    /// What becomes of a metric of time; its sentence.
    [[nodiscard]] std::pair<Direction, std::string> judged(const std::string& metric = "time.ratio") const {
        const std::vector<Change> changes = of(gate(options_), metric);
        return changes.empty() ? std::pair(Direction::Same, std::string("none"))
                               : std::pair(changes[0].direction, changes[0].sentence);
    }
};

TEST_F(TimeOfStandIns, AsLongIsTheSameAndLongerIsWorse) {
    base_.takes("100", "100");
    head_.takes("100", "100");
    EXPECT_EQ(judged().first, Direction::Same);
    EXPECT_NE(judged().second.find("1.0 % or more would have been told"), std::string::npos) << judged().second;
    head_.takes("105", "105");
    EXPECT_EQ(judged().first, Direction::Worse);
    EXPECT_NE(judged().second.find("pcf on tiny: a frame takes 1.050 of the base's CPU time, surely more than 1.050"),
              std::string::npos);
    EXPECT_EQ(judged("time.wall_ratio").second, "none") << "its CPU time says it all";
}

TEST_F(TimeOfStandIns, AHeadThatWaitsIsWorseByItsWallTime) {
    base_.takes("100", "100");
    head_.takes("100", "150");
    EXPECT_EQ(judged().first, Direction::Same);
    EXPECT_EQ(judged("time.wall_ratio").first, Direction::Worse);
}

// Its restarts lie on both sides of 1.2 % slower, each time as far, so that the estimate stays there and nothing is certain.
TEST_F(TimeOfStandIns, WhatStaysUncertainIsUnclear) {
    base_.takes("10000", "10000");
    head_.takes("10120 + (start % 2 ? 1 : -1) * (50 + 10 * (start / 2 % 48))", "10000");
    head_.does("time-frames", countStarts + readFile(head_.program().parent_path() / "time-frames.sh"));
    const auto [direction, sentence] = judged();
    EXPECT_EQ(direction, Direction::Unclear) << sentence;
    EXPECT_NE(sentence.find("which 1920 rounds leave uncertain"), std::string::npos) << sentence;
}

// The same, a tenth apart by logarithms: what this run could have told is more than anybody would accept.
TEST_F(TimeOfStandIns, WhatStaysUncertainAndCouldNotBeToldIsNotJudged) {
    base_.takes("10000", "10000");
    head_.takes("10130 + d * d / 20000 + (start % 2 ? 1 : -1) * d", "10000");
    head_.does("time-frames", countStarts + "d=$((500 + 20 * (start / 2 % 48)))\n" +
                                  readFile(head_.program().parent_path() / "time-frames.sh"));
    const auto [direction, sentence] = judged();
    EXPECT_EQ(direction, Direction::NotCompared) << sentence;
    EXPECT_NE(sentence.find("% or more would have been told"), std::string::npos) << sentence;
}

TEST_F(TimeOfStandIns, OnAMachineThatIsNotSteadyNothingIsJudged) {
    base_.takes("100 + 30 * first", "100"); // the base, and once more as the control
    base_.does("time-frames", orderPairs + readFile(base_.program().parent_path() / "time-frames.sh"));
    head_.takes("100", "100");
    const auto [direction, sentence] = judged();
    EXPECT_EQ(direction, Direction::NotCompared) << sentence;
    EXPECT_NE(sentence.find("the machine is not steady enough"), std::string::npos) << sentence;
}

TEST_F(TimeOfStandIns, WithoutATimedCellThereIsANote) {
    base_.lists("techniques", R"([{"id": "none", "variants": [""], "parameters": []}])"); // it does not know the cell
    EXPECT_TRUE(has(gate(options_).notes, "time is not compared: none of the chosen cells is timed"));
}

} // namespace
} // namespace shadowbench::gate
