// Not for people: what `run --cost instructions` runs under Callgrind.
#include "cli/command.h"
#include "harness/measure/callgrind.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace shadowbench {

void addCountFrames(CLI::App& app, Action& action) {
    const auto job = std::make_shared<timing::CountJob>();
    const auto profile = std::make_shared<std::string>("gate");
    const auto variants = std::make_shared<std::filesystem::path>();
    CLI::App* verb = app.add_subcommand("count-frames", "Renders steady frames between Callgrind's client requests");
    verb->group(""); // left out of --help
    verb->add_option("--scene", job->scene)->required();
    verb->add_option("--techniques", *variants)->required(); // a file of them
    verb->add_option("--profile", *profile);
    verb->add_option("--seed", job->seed);
    verb->callback([&action, job, profile, variants] {
        action = [job, profile, variants] {
            job->profile = profileNamed(*profile);
            timing::renderCountedFrames(*job, *variants);
            return ExitCode::Pass;
        };
    });
}

} // namespace shadowbench
