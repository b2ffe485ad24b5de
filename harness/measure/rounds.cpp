#include "harness/measure/rounds.h"

#include "techniques/gl/context.h"

#include <algorithm>
#include <chrono>

namespace shadowbench::timing {
namespace {

using Clock = std::chrono::steady_clock;

} // namespace

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double wallMilliseconds(const std::function<void()>& work) {
    gl::Context& context = gl::Context::current();
    context.finish();
    const auto start = Clock::now();
    work();
    context.finish();
    return 1000 * secondsSince(start);
}

void timeRounds(std::vector<Runner*> runners, const TimingLimits& limits, const std::function<void()>& beginRound) {
    std::erase_if(runners, [](const Runner* runner) { return !runner->frame; });
    const auto start = Clock::now();
    for (int round = 0; round < limits.maximumRounds; ++round) {
        if (round >= limits.minimumRounds && secondsSince(start) > limits.budgetSeconds) break;
        beginRound();
        for (Runner* runner : runners) {
            if (runner->before) runner->before();
            runner->samples.push_back(wallMilliseconds(runner->frame));
        }
        std::ranges::reverse(runners);
    }
}

std::vector<double> quotients(const std::vector<double>& numerators, const std::vector<double>& denominators) {
    std::vector<double> result(numerators.size());
    std::ranges::transform(numerators, denominators, result.begin(), std::divides<>());
    return result;
}

} // namespace shadowbench::timing
