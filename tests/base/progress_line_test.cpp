// Progress where no terminal is: few lines, however often it is shown.
#include "base/progress_line.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace shadowbench {
namespace {

/// When lines are written in work of `length` seconds that says what it does a hundred times a second.
std::vector<double> timesOfLines(double length) {
    std::vector<double> times;
    double last = 0;
    for (int tick = 0; tick < length * 100; ++tick)
        if (logLineIsDue(tick / 100.0, last)) times.push_back(last = tick / 100.0);
    return times;
}

TEST(ProgressLine, WithoutATerminalThereIsALineEveryTenSecondsAtMostAndOneAMinuteAtLeast) {
    const std::vector<double> times = timesOfLines(3600);
    ASSERT_GT(times.size(), 55U);
    double last = 0;
    for (const double time : times) {
        EXPECT_GE(time - last, 10);
        EXPECT_LE(time - last, 60.01);
        last = time;
    }
}

TEST(ProgressLine, WorkOfFiveMinutesHasAHandfulOfLines) { EXPECT_LE(timesOfLines(300).size(), 8U); }

TEST(ProgressLine, ShortWorkWritesNothingWithoutATerminal) {
    testing::internal::CaptureStderr(); // a file
    {
        ProgressLine line("work", 1000, false);
        for (int step = 0; step < 1000; ++step) line.show(step, 0, "step " + std::to_string(step));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressLine, AQuietOneWritesNothing) {
    testing::internal::CaptureStderr();
    { ProgressLine("work", 1, true).show(0, 0.5, "a step"); }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace shadowbench
