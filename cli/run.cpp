#include "harness/runs/run.h"

#include "base/folder_lock.h"
#include "base/trace.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/run_result.h"
#include "harness/foreign/renderers.h"
#include "techniques/folder/description.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <new>
#include <optional>

namespace shadowbench {
namespace {

/// The part of a run that is asked for; none: the whole run.
struct PartOptions {
    bool manifest = false;
    std::optional<std::string> shard;
    std::optional<std::size_t> cell;

    [[nodiscard]] bool any() const { return manifest || shard || cell; }
};

shards::CellRange rangeOf(const PartOptions& part, std::size_t cells) {
    if (part.shard) return shards::shardRange(*part.shard, cells);
    if (part.cell) return shards::cellRange(*part.cell, cells);
    return {};
}

ExitCode measureAndPrint(const RunOptions& options, const PartOptions& part) {
    const std::vector<shards::ManifestCell> manifest = shards::plannedCells(options);
    const shards::CellRange range = rangeOf(part, manifest.size());
    {
        const OutputLock alone(options.out); // of parts that start at the same time one writes the manifest
        shards::freezeManifest(options.out, manifest);
    }
    fmt::print("manifest: {}, {} cells\n", shards::manifestFile(options.out).string(), manifest.size());
    if (part.manifest) return ExitCode::Pass;

    const shards::Measured measured = shards::measureCells(options, manifest, range);
    for (const std::string& error : measured.errors) fmt::print(stderr, "error, kept for merge: {}\n", error);
    for (const std::string& transient : measured.transient) fmt::print(stderr, "worth a retry: {}\n", transient);
    fmt::print("cells: {} measured, {} were there, {} to be tried again, in {}\n",
               measured.cells - measured.kept - measured.transient.size(), measured.kept, measured.transient.size(),
               (options.out / "cells").string());
    return measured.transient.empty() ? ExitCode::Pass : ExitCode::Transient;
}

/// Whatever may go well at the next try ends with its own code: only then is a retry worth it.
ExitCode runPart(const RunOptions& options, const PartOptions& part) {
    try {
        return measureAndPrint(options, part);
    } catch (const Error& error) {
        if (!error.isTransient()) throw;
        throw Error(ExitCode::Transient, error.what());
    } catch (const std::bad_alloc&) {
        throw Error(ExitCode::Transient, "there is not enough memory for this part of the run; give it more");
    }
}

/// Not by a pattern, or technique folders.
bool namesRows(const std::vector<std::string>& techniques) {
    return !techniques.empty() && std::ranges::none_of(techniques, [](const std::string& word) {
        return word.find_first_of("*?[") != std::string::npos && !word.starts_with(techniques::folderPrefix);
    });
}

ExitCode runAndPrint(const RunOptions& options, bool standing) {
    const OutputLock alone(options.out); // the records of two runs at once would replace each other
    const bool costs = options.measure.timed() || options.instructions;
    const bool everyRow = namesRows(options.techniques);
    RunOptions told = options;
    if (!costs || !everyRow) // else the few rows are printed once, with what they cost
        told.sceneScored = [&](const std::vector<Record>& scene) {
            printTables(scene, options.out, {.standing = standing, .everyRow = everyRow});
        };
    const RunResult result = run(told);
    const Span span("files", "pages");
    return reportResult(result, options.out, {.standing = standing, .everyRow = everyRow, .printed = !costs});
}

} // namespace

void addRun(CLI::App& app, Action& action) {
    const auto options = std::make_shared<RunOptions>();
    const auto profile = std::make_shared<std::string>("gate");
    const auto cost = std::make_shared<std::vector<std::string>>(1, "time");
    const auto images = std::make_shared<bool>(false);
    const auto standing = std::make_shared<bool>(false);
    const auto external = std::make_shared<std::vector<std::filesystem::path>>();
    const auto revision = std::make_shared<std::string>();
    const auto part = std::make_shared<PartOptions>();
    const auto traced = std::make_shared<std::filesystem::path>();
    CLI::App* verb = app.add_subcommand("run", "Renders and scores cells: scenes × techniques");
    verb->footer(
        "Examples:\n  shadowbench run\n  shadowbench run --scene dueling-frusta --technique 'sm-*' --technique "
        "volume-zfail\n"
        "  shadowbench run --scene my.toml --technique pcss:taps=32+32,map=2048 --profile standard --images --out "
        "results/mine\n  shadowbench run --cost instructions --scene windmills\n"
        "  shadowbench run --technique 'external:*' --external engine.toml    (renderers that are not ours: "
        "docs/external.md)\n"
        "Large runs, in parts:\n  shadowbench run --profile paper --out results/large --shard 2/8    (and 1/8 … "
        "8/8, anywhere)\n  shadowbench merge results/large\n"
        "A part exits with 0 once it has measured its cells, whatever they score: merge judges. It exits with 75 "
        "when\na cell is worth a retry (a full disk, a killed tool, no memory); run it again, finished cells stay.");
    verb->add_option("--scene", options->scenes, "Scene id or file; repeatable (default: the standard scenes)");
    verb->add_option("--technique", options->techniques,
                     "Variant such as pcss:taps=32+32, or a glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, options->techniques);
    verb->add_option("--external", *external,
                     "File that describes renderers to call, whose techniques are external:ID; repeatable");
    verb->add_option("--revision", *revision,
                     "Commit of those renderers' sources, which their records keep (default: as git describes the folder of "
                     "the file)");
    addProfileOption(*verb, *profile);
    verb->add_option("--out", options->out, "Folder of records and report")->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addSeedOption(*verb, options->measure.seed);
    addGlOption(*verb);
    verb->add_option("--seeds", options->measure.seeds,
                     "Render what depends on the seed with so many seeds, from --seed on, and split its error into bias and "
                     "noise (stability.seeds)")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    verb->add_option("--views", options->measure.views,
                     "Score what keeps no history from so many still views, the eye turned about what it looks at by 10° to "
                     "either side, then 20° …: errors are then their mean, with the worst beside")
        ->check(CLI::Range(1, 15))
        ->capture_default_str();
    verb->add_flag("--neighbours", options->measure.neighbours,
                   "Score each row again with its map, and with the image, a fortieth larger; a row whose error changes by "
                   "more than a factor of two is marked (sanity)");
    verb->add_flag("--resume", options->resume, "Keep the cells that --out already holds of this program, run the rest");
    verb->add_flag("--images", *images,
                   "Write visibility, reference and error of each cell as EXR and PNG, too, and pictures of walks");
    verb->add_option("--cost", *cost,
                     "What is measured beside work counters: time, instructions (under Valgrind, the same in every run), "
                     "screen (times by pass on an image of 1024², too, which show what grows with the screen), several as "
                     "time,screen, or none: the records of two runs are then equal")
        ->delimiter(',')
        ->check(CLI::IsMember({"time", "instructions", "screen", "none"}))
        ->capture_default_str();
    addStaticOption(*verb, *standing);
    verb->add_option("--jobs", options->jobs,
                     "Processes that score cells at the same time (default: one a processor); times are taken one after the "
                     "other")
        ->check(CLI::Range(1, 1024));
    CLI::Option* shard = verb->add_option("--shard", part->shard,
                                          "Measure part i of n of the cells only, each into a file of --out; `merge` joins "
                                          "them");
    CLI::Option* cell = verb->add_option("--cell", part->cell, "Measure this cell only: a line number of the manifest");
    CLI::Option* manifest =
        verb->add_flag("--manifest", part->manifest, "Measure nothing; write manifest.jsonl: what parts would measure");
    shard->excludes(cell, manifest);
    cell->excludes(manifest);
    verb->add_option("--trace", *traced,
                     "File that says where the run's time goes, by process and cell, for https://ui.perfetto.dev or "
                     "chrome://tracing");
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, profile, cost, images, standing, external, revision, part, traced] {
        action = [options, profile, cost, images, standing, external, revision, part, traced] {
            std::optional<Trace> trace;
            if (!traced->empty()) trace.emplace(*traced);
            options->measure.external = foreign::renderersOf(*external, {options->out / "logs", *revision});
            options->profile = profileNamed(*profile);
            options->measure.time = std::find(cost->begin(), cost->end(), "time") != cost->end();
            options->measure.otherScreen = std::find(cost->begin(), cost->end(), "screen") != cost->end();
            options->instructions = std::find(cost->begin(), cost->end(), "instructions") != cost->end();
            options->measure.images = options->out / "images";
            options->measure.pictures = *images;
            warnOfFolders();
            return part->any() ? runPart(*options, *part) : runAndPrint(*options, *standing);
        };
    });
}

} // namespace shadowbench
