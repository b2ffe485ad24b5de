// What is left of a verb that is killed, and what the next run makes of it.
#pragma once

#include "tools/faults/failing_calls.h"

#include <random>

namespace shadowbench::faults {

/// A signal at the `at`-th call of a verb, to its own process or to the one that makes the call.
struct Kill {
    int signal = 0;
    bool child = false;
    std::uint64_t at = 0;
};

/// How many calls of a verb a kill can be at.
std::uint64_t countMoments(Sandbox& sandbox, const Verb& verb);

/// The same of one seed everywhere.
Kill drawKill(std::mt19937& random, std::uint64_t moments);

Trial killAt(Sandbox& sandbox, const Verb& verb, const Kill& kill, std::uint64_t moments);

std::string killsReport(const std::vector<Trial>& trials, const std::string& command);

} // namespace shadowbench::faults
