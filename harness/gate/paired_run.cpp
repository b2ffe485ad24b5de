#include "harness/gate/paired_run.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowbench::gate {
namespace {

enum Contestant : std::size_t { Base, Head, Control };

} // namespace

PairedSamples measurePaired(const std::filesystem::path& base, const std::filesystem::path& head,
                            const timing::WorkerJob& job, const std::string& variant, const PairedOptions& options) {
    PairedSamples samples;
    std::mt19937 random(options.seed);
    for (int restart = 0; restart < options.restarts; ++restart) {
        std::array<timing::FrameWorker, 3> workers{timing::FrameWorker(base, job), timing::FrameWorker(head, job),
                                                   timing::FrameWorker(base, job)};
        for (timing::FrameWorker& worker : workers) worker.frame(variant); // warm
        std::array<std::size_t, 3> order{Base, Head, Control};
        for (int round = 0; round < options.rounds; ++round) {
            if (round % 2 == 0)
                std::shuffle(order.begin(), order.end(), random);
            else
                std::reverse(order.begin(), order.end());
            std::array<double, 3> cpu{};
            for (const std::size_t who : order) cpu[who] = workers[who].frame(variant).cpu;
            samples.headToBase.push_back(std::log(cpu[Head] / cpu[Base]));
            samples.controlToBase.push_back(std::log(cpu[Control] / cpu[Base]));
        }
    }
    return samples;
}

} // namespace shadowbench::gate
