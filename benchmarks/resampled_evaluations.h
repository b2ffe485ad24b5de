// More evaluations than there is time to measure: made of the restarts of measured ones, which are independent of each
// other.
#pragma once

#include "benchmarks/timed_evaluations.h"

#include <random>

namespace shadowbench::benchmarks {

/// Verdicts by count, and the restarts that they took.
struct Verdicts {
    int pass = 0, unclear = 0, slower = 0, controlAlarms = 0, restarts = 0;
    [[nodiscard]] int all() const { return pass + unclear + slower; }
};

void count(Verdicts& verdicts, const gate::TimeJudgement& judgement);

/// All restarts that were measured of one cell.
struct Pool {
    gate::TimedCell cell;
    gate::PairedSamples samples;
};
std::vector<Pool> pools(const std::vector<Evaluation>& evaluations);

struct Resampling {
    gate::PairedOptions options;
    int cells = 1;       // that share the rule's α
    double slowdown = 0; // by which the head's CPU time is made longer
};

/// Draws restarts of the pool with replacement, as many as the gate would measure, exchanges base, head and control at
/// random in each (they are one program), and judges them.
gate::TimeJudgement judgeResample(const Pool& pool, const Resampling& resampling, std::mt19937& random);

} // namespace shadowbench::benchmarks
