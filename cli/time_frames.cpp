// Not for people: the worker that paired timings ask for frames.
#include "cli/command.h"
#include "harness/measure/timed_frames.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

namespace shadowbench {

void addTimeFrames(CLI::App& app, Action& action) {
    const auto job = std::make_shared<timing::WorkerJob>();
    const auto profile = std::make_shared<std::string>("gate");
    CLI::App* verb = app.add_subcommand("time-frames", "Renders a frame for each variant named on standard input");
    verb->group(""); // left out of --help
    verb->add_option("--scene", job->scene)->required();
    verb->add_option("--profile", *profile);
    verb->add_option("--seed", job->seed);
    verb->callback([&action, job, profile] {
        action = [job, profile] {
            job->profile = profileNamed(*profile);
            timing::answerWithTimes(*job, std::cin, std::cout);
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
