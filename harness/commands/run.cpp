#include "harness/run/run.h"

#include "harness/commands/command.h"
#include "harness/commands/written_report.h"
#include "harness/report/lod_report.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

/// Scene ids in the order of the records.
std::vector<std::string> scenesOf(const std::vector<Record>& records) {
    std::vector<std::string> scenes;
    for (const Record& record : records)
        if (std::find(scenes.begin(), scenes.end(), record.scene) == scenes.end()) scenes.push_back(record.scene);
    return scenes;
}

ExitCode runAndPrint(const RunOptions& options) {
    const RunResult result = run(options);
    const report::Written written = report::writeReport(result.records, options.out);
    for (const std::string& scene : scenesOf(result.records)) {
        fmt::print("{}\n", report::terminalTable(result.records, scene));
        const std::string lod = report::lodTerminalTable(result.records, scene);
        if (!lod.empty()) fmt::print("{}\n", lod);
    }
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    fmt::print("records: {}\n", (options.out / "results.jsonl").string());
    print(written);
    return result.code;
}

} // namespace

void addRun(CLI::App& app, Action& action) {
    const auto options = std::make_shared<RunOptions>();
    const auto profile = std::make_shared<std::string>("gate");
    const auto cost = std::make_shared<std::vector<std::string>>(1, "time");
    CLI::App* verb = app.add_subcommand("run", "Renders and scores cells: scenes × techniques");
    verb->footer("Examples:\n  shadowbench run\n  shadowbench run --scene dueling-frusta --technique 'sm-*' --technique "
                 "volume-zfail\n"
                 "  shadowbench run --scene my.toml --technique pcss:taps=32+32,map=2048 --profile standard --images --out "
                 "results/mine\n  shadowbench run --cost instructions --scene windmills");
    verb->add_option("--scene", options->scenes, "Scene id or file; repeatable (default: the standard scenes)");
    verb->add_option("--technique", options->techniques,
                     "Variant such as pcss:taps=32+32, or a glob over ids; repeatable (default: all)");
    verb->add_option("--profile", *profile, "gate, standard or paper")->capture_default_str();
    verb->add_option("--out", options->out, "Folder of records and report")->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_option("--seed", options->seed, "Seed of pseudo-random choices")
        ->check(CLI::Range(1U, 100000U))
        ->capture_default_str();
    verb->add_flag("--resume", options->resume, "Keep the cells that --out already holds, run the rest");
    verb->add_flag("--images", options->images, "Write visibility, reference and error of each cell as EXR and PNG");
    verb->add_option("--cost", *cost,
                     "What is measured beside work counters: time, instructions (under Valgrind, the same in every run), "
                     "both as time,instructions, or none: the records of two runs are then equal")
        ->delimiter(',')
        ->check(CLI::IsMember({"time", "instructions", "none"}))
        ->capture_default_str();
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, profile, cost] {
        action = [options, profile, cost] {
            options->profile = profileNamed(*profile);
            options->time = std::find(cost->begin(), cost->end(), "time") != cost->end();
            options->instructions = std::find(cost->begin(), cost->end(), "instructions") != cost->end();
            return runAndPrint(*options);
        };
    });
}

} // namespace shadowbench
