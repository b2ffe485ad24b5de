#include "gate/gate.h"

#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/gate_result.h"
#include "cli/options.h"
#include "gate/gate_report.h"
#include "gate/verdict.h"
#include "harness/foreign/renderers.h"
#include "site/gate_site.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

ExitCode gateAndPrint(const gate::GateOptions& options, const GateFiles& files) {
    const OutputLock alone(options.out);
    return writeGate(gate::gate(options), options, files);
}

/// What a gate asks of its base.
void addPolicy(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("policy", "Prints commit, hash of the sources and what a gate by this build judges");
    verb->group(""); // left out of --help
    verb->callback([&action] {
        action = [] {
            fmt::print("{}", gate::toJson(gate::ownBuildInfo()));
            return ExitCode::Pass;
        };
    });
}

} // namespace

void addGate(CLI::App& app, Action& action) {
    addPolicy(app, action);
    const auto options = std::make_shared<gate::GateOptions>();
    const auto files = std::make_shared<GateFiles>();
    const auto profile = std::make_shared<std::string>("gate");
    const auto cost = std::make_shared<std::vector<std::string>>(std::vector<std::string>{"shader", "instructions", "time"});
    CLI::App* verb = app.add_subcommand("gate", "Judges this build against another: is anything worse?");
    verb->footer(
        "Examples:\n  shadowbench gate --base origin/main --junit gate.xml --summary gate.md --annotations\n"
        "  shadowbench gate --base ../main/build/release --technique 'sm-*' --scene windmills --cost none\n"
        "  shadowbench gate --base results/published/results.jsonl\n"
        "  shadowbench gate --base engine-before/results.jsonl --technique 'external:*' --external engine.toml --cost none\n"
        "Exits with 5 when something could not be judged or base and head are one program, else with 4 when accuracy or "
        "stability\nis worse, 3 when only cost is, and 0 when nothing is. The stricter of both sides' policies judges. "
        "A killed gate goes on\nwhere it was. What the change cannot have reached is not measured but for a sample.\n"
        "With --all the head's records are left in --out: as the --base of later gates they accept what this one found.");
    verb->add_option("--base", options->base,
                     "A build folder or program, a git revision (built once and kept), or records (then neither time nor "
                     "shaders are judged)");
    verb->add_option("--scene", options->scenes, "Scene id or file; repeatable (default: the standard scenes)");
    verb->add_option("--technique", options->techniques, "Variant, or a glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, options->techniques);
    verb->add_option("--external", options->externalFiles,
                     "File that describes renderers to call, whose rows are compared with those of --base; repeatable");
    addProfileOption(*verb, *profile);
    verb->add_option(
            "--cost", *cost,
            "What is judged beside accuracy and stability: shader, instructions, time, several as shader,time, or none")
        ->delimiter(',')
        ->check(CLI::IsMember({"shader", "instructions", "time", "none"}))
        ->capture_default_str();
    verb->add_option("--bounds", options->bounds,
                     "Bounds, sweeps and the cells whose cost is judged; outside a clone those that the program carries")
        ->capture_default_str();
    verb->add_option("--out", options->out, "Folder of the page and of pictures of failing cells")->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references, builds and records (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addSeedOption(*verb, options->seed);
    addGlOption(*verb);
    addGateFiles(*verb, *files);
    verb->add_flag("--all", options->all, "Measure also what the change cannot have reached");
    verb->add_flag("--same-program", options->sameProgram,
                   "Base and head are one program, on purpose: does the gate stay silent?");
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, files, profile, cost] {
        action = [options, files, profile, cost] {
            options->profile = profileNamed(*profile);
            options->instructions = std::ranges::find(*cost, "instructions") != cost->end();
            options->shader = std::ranges::find(*cost, "shader") != cost->end();
            options->time = std::ranges::find(*cost, "time") != cost->end();
            options->external = foreign::renderersOf(options->externalFiles);
            return gateAndPrint(*options, *files);
        };
    });
}

} // namespace shadowbench
