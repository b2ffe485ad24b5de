// Measured evaluations of the paired-time tier, kept with all their samples so that they can be judged again.
#pragma once

#include "gate/paired_run.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace shadowbench::benchmarks {

/// What one cell's frames took.
struct MeasuredCell {
    gate::TimedCell cell;
    gate::PairedSamples samples;
};

/// One gate: cells measured together.
struct Evaluation {
    std::uint32_t seed = 1;
    bool samePrograms = true; // base and head: every alarm is a false one
    int loaders = 0;          // processes that did nothing but load the machine meanwhile
    double loadAverage = 0;   // of the machine, over the last minute, when it ended
    std::vector<MeasuredCell> cells;
};

/// Evaluations in a file of JSON lines; none if there is no such file. Throws BadInput for what is no such line, but for a
/// last one that a kill cut short.
std::vector<Evaluation> readEvaluations(const std::filesystem::path& file);

void appendEvaluation(const std::filesystem::path& file, const Evaluation& evaluation);

} // namespace shadowbench::benchmarks
