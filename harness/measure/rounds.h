// Frames that take turns, so that what the machine does meets all alike.
#pragma once

#include <chrono>
#include <functional>
#include <vector>

namespace shadowbench::timing {

/// How long frames are timed.
struct TimingLimits {
    int minimumRounds = 3;
    int maximumRounds = 25;
    double budgetSeconds = 0.3; // once the minimum is done
};

/// One that takes turns.
struct Runner {
    std::function<void()> frame = {};  // empty: it does not take part
    std::function<void()> before = {}; // each of its frames, untimed; empty: nothing
    std::vector<double> samples = {};  // ms
};

double secondsSince(std::chrono::steady_clock::time_point start);

/// Wall time of `work`, all GL work finished on both sides.
double wallMilliseconds(const std::function<void()>& work);

/// Times a frame of each in every round, in an order that alternates. `beginRound` is called before each round.
void timeRounds(std::vector<Runner*> runners, const TimingLimits& limits, const std::function<void()>& beginRound);

/// `numerators[i] / denominators[i]`, equally many.
std::vector<double> quotients(const std::vector<double>& numerators, const std::vector<double>& denominators);

} // namespace shadowbench::timing
