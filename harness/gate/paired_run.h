// Frames of two programs in turns: what the paired-time rule judges.
#pragma once

#include "harness/gate/paired.h"
#include "harness/timing/timed_frames.h"

#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct PairedOptions {
    int restarts = 5; // of all workers: where a process lies in memory moves its speed
    int rounds = 20;  // of one frame each, a restart
    std::uint32_t seed = 1;
};

/// Log-ratios of CPU time a frame, one a round.
struct PairedSamples {
    std::vector<double> headToBase, controlToBase;
};

/// Starts three workers, base, head and base again as the control, and has each render a frame a round, in an order that is
/// drawn anew and then reversed, round by round. CPU time, for another process on the core does not count in it. Samples of
/// all restarts. Throws what the workers throw.
PairedSamples measurePaired(const std::filesystem::path& base, const std::filesystem::path& head,
                            const timing::WorkerJob& job, const std::string& variant, const PairedOptions& options);

} // namespace shadowbench::gate
