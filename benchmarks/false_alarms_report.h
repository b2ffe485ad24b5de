// How often the paired-time tier errs, in Markdown.
#pragma once

#include "benchmarks/timed_evaluations.h"

#include <string>
#include <vector>

namespace shadowbench::benchmarks {

/// Evaluations made under the same circumstances.
struct Experiment {
    std::string name;
    std::vector<Evaluation> evaluations; // not empty
};

/// What the rule makes of the evaluations, counted; and, where base and head are one program, of `resamples` cells a line
/// made of their restarts with the head's times made longer, and of twenty times as many as they are. `options` are those of
/// the evaluations.
std::string errorReport(const std::vector<Experiment>& experiments, const gate::PairedOptions& options, int resamples);

} // namespace shadowbench::benchmarks
