// Two programs timed in turns: with stand-ins that answer any times wanted, and with the built program.
#include "base/error.h"
#include "gate/paired_run.h"
#include "tests/support/program.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace shadowbench::gate {
namespace {

class PairedTime : public ::testing::Test {
protected:
    /// A program that runs `answer` in a shell for each line it is asked; $count frames, $turn numbers the lines from 1.
    [[nodiscard]] std::string program(const std::string& name, const std::string& answer) const {
        std::string file = folder_.write(name, "#!/bin/sh\nturn=0\nwhile read count variant; do\n"
                                               "turn=$((turn + 1))\n" +
                                                   answer + "\ndone\n");
        std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        return file;
    }
    /// One that takes so many milliseconds a frame.
    [[nodiscard]] std::string taking(int milliseconds) const {
        return program(fmt::format("taking-{}", milliseconds), fmt::format("echo $((count * {})) 1", milliseconds));
    }
    static std::vector<TimeJudgement> judge(const std::string& base, const std::string& head,
                                            const std::vector<TimedCell>& cells = {{"simple", "none"}}) {
        PairedOptions options;
        options.restarts = 2;
        return judgePairedTime(base, head, cells, options, {});
    }
    static std::string complaint(const std::string& base, const TimedCell& cell) {
        try {
            judge(base, base, {cell});
        } catch (const Inconclusive& error) {
            return error.what();
        }
        return "none";
    }

    Folder folder_;
};

TEST_F(PairedTime, AConstantSlowdownIsFoundInEveryCell) {
    const auto judgements =
        judge(taking(100), taking(105), {{"simple", "none"}, {"dueling-frusta", "pcf"}, {"simple", "pcss"}});
    ASSERT_EQ(judgements.size(), 3U);
    for (const TimeJudgement& judgement : judgements) {
        EXPECT_EQ(judgement.verdict, TimeVerdict::Slower);
        EXPECT_NEAR(judgement.ratio, 1.05, 1e-9);
        EXPECT_NEAR(judgement.lowerBound, 1.05, 1e-9);
        EXPECT_EQ(judgement.rounds, 240);
        EXPECT_FALSE(judgement.controlAlarm);
        EXPECT_EQ(judgement.samples.restarts.size(), 12U); // 3⁻⁶ > 0.01/3/4, the share of a look at a cell
    }
    EXPECT_EQ(judgements[1].cell.scene, "dueling-frusta");
    EXPECT_EQ(judgements[2].cell.variant, "pcss");
}

TEST_F(PairedTime, ASpeedUpAndASlowdownUnderTheFloorPass) {
    for (const int head : {1009, 700}) {
        const TimeJudgement judgement = judge(taking(1000), taking(head))[0];
        EXPECT_EQ(judgement.verdict, TimeVerdict::Pass);
        EXPECT_EQ(judgement.rounds, 40);
    }
}

TEST_F(PairedTime, AHeadThatSleepsIsFoundByItsWallTime) {
    const auto waiting = [&](const std::string& name, int wall) {
        return program(name, fmt::format("echo $((count * 100)) $((count * {}))", wall));
    };
    const TimeJudgement sleeps = judge(waiting("base", 100), waiting("sleeps", 120))[0];
    EXPECT_EQ(sleeps.verdict, TimeVerdict::Pass) << "it takes no CPU time for it";
    EXPECT_TRUE(sleeps.waits);
    EXPECT_NEAR(sleeps.wallRatio, 1.2, 1e-9);
    EXPECT_FALSE(judge(waiting("base", 100), waiting("within", 104))[0].waits);
    EXPECT_FALSE(judge(taking(100), taking(120))[0].waits) << "which is slower, and does not wait";
}

TEST_F(PairedTime, AnUnclearCellIsMeasuredOnUntilALookDecides) {
    PairedOptions options;
    options.restarts = 1;
    const TimeJudgement judgement = judgePairedTime(taking(100), taking(110), {{"simple", "none"}}, options, {})[0];
    EXPECT_EQ(judgement.samples.restarts.size(), 12U); // of looks at 3, 6, 12 and 24 on two clocks: 3⁻⁶ > 0.01/8 > 3⁻¹²
    EXPECT_EQ(judgement.verdict, TimeVerdict::Slower);
}

TEST_F(PairedTime, AnUnclearCellPassesAsSoonAsItIsNoSlower) {
    // Slow in two restarts, then fast.
    const std::string came = folder_ / "came";
    const std::string head =
        program("head", fmt::format("[ $turn = 1 ] && {{ echo >> {0}; [ $(wc -l < {0}) -le 2 ] && t=110 || t=90; }}\n"
                                    "echo $((count * t)) 1",
                                    came));
    PairedOptions options;
    options.restarts = 1;
    const TimeJudgement judgement = judgePairedTime(taking(100), head, {{"simple", "none"}}, options, {})[0];
    EXPECT_EQ(judgement.verdict, TimeVerdict::Pass);
    EXPECT_EQ(judgement.samples.restarts.size(), 4U);
}

TEST_F(PairedTime, EqualProgramsThatTakeDifferentTimesAreAnAlarm) {
    // Of base and control, whoever comes first and makes the folder is faster.
    const std::string marker = folder_ / "came";
    const std::string base =
        program("base", fmt::format("[ $turn = 1 ] && {{ mkdir {} 2>/dev/null && t=100 || t=103; }}\necho $((count * t)) 1",
                                    marker));
    PairedOptions options;
    options.restarts = 1;
    const auto judgements = judgePairedTime(base, taking(100), {{"simple", "none"}}, options, {});
    EXPECT_TRUE(judgements[0].controlAlarm);
}

TEST_F(PairedTime, AShortFrameIsTimedWithOthers) {
    const std::string quick = program("quick", "echo $((count * 5 / 10)).$((count * 5 % 10)) 1");
    const TimeJudgement judgement = judge(quick, quick)[0];
    EXPECT_EQ(judgement.samples.framesPerTurn, 8); // of half a millisecond each: 4 ms a turn
    EXPECT_EQ(judge(taking(100), taking(100))[0].samples.framesPerTurn, 1);
}

TEST_F(PairedTime, WhatCannotBeTimedIsInconclusiveAndNamed) {
    const std::string old = folder_.write("old", "#!/bin/sh\necho 'shadowbench: there is no verb \"time-frames\"; the "
                                                 "verbs are: run' >&2\nexit 2\n");
    std::filesystem::permissions(old, std::filesystem::perms::owner_all);
    EXPECT_EQ(complaint(old, {"simple", "none"}), old + " has no verb time-frames: it was built from a commit before paired "
                                                        "timing; choose a later one");
    const std::string failing = program("failing", "echo error it rains");
    EXPECT_EQ(complaint(failing, {"simple", "none"}), "timing none on scene simple with " + failing + " failed: it rains");
    EXPECT_NE(complaint(PROGRAM, {"simple", "no-such-technique"}).find("no-such-technique on scene simple with " PROGRAM),
              std::string::npos);
    EXPECT_NE(complaint(PROGRAM, {"no-such-scene", "none"}).find("no-such-scene"), std::string::npos);
    EXPECT_NE(complaint("/nowhere/shadowbench", {"simple", "none"}).find("/nowhere/shadowbench"), std::string::npos);
}

TEST_F(PairedTime, TheProgramTimesItsFrames) {
    PairedOptions options;
    options.restarts = 1;
    options.rounds = 20;
    const std::string scene = folder_.write("tiny.toml", tinyScene());
    const auto judgements = judgePairedTime(PROGRAM, PROGRAM, {{scene, "pcf"}, {scene, "sm-history"}}, options, {});
    for (const TimeJudgement& judgement : judgements)
        for (const PairedRound& round : judgement.samples.restarts.at(0))
            for (const timing::FrameTime& time : {round.base, round.head, round.control}) {
                EXPECT_GT(time.cpu, 0) << judgement.cell.variant; // how much depends on the machine
                // A thread cannot use more than all of the time. The coarse clock of a process under a limit says so of
                // every other frame; the driver's other threads do next to nothing.
                EXPECT_LE(time.cpu, 1.02 * time.wall + 0.2) << judgement.cell.variant;
            }
}

TEST_F(PairedTime, ALimitOnCpuTimeIsInconclusiveBecauseItMakesTheClockCoarse) {
    rlimit before{};
    getrlimit(RLIMIT_CPU, &before);
    const rlimit limited{100'000, before.rlim_max};
    setrlimit(RLIMIT_CPU, &limited);
    const std::string said = complaint(taking(1), {"simple", "none"});
    setrlimit(RLIMIT_CPU, &before);
    EXPECT_NE(said.find("ulimit -t unlimited"), std::string::npos) << said;
    EXPECT_EQ(complaint(taking(1), {"simple", "none"}), "none");
}

} // namespace
} // namespace shadowbench::gate
