#include "studies/sweep/sweep.h"

#include "base/files.h"
#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/options.h"
#include "report/charts.h"
#include "report/lod_report.h"
#include "report/run_report.h"
#include "studies/sweep/axis.h"
#include "studies/sweep/viewport_curve.h"
#include "techniques/gl/context.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace shadowbench {
namespace {

/// The axis of level-of-detail techniques, whose records have costs and no errors.
ExitCode viewportsAndPrint(const SweepOptions& options, const std::filesystem::path& out) {
    const SweepResult result = lod::viewportCurve(options);
    const OutputLock alone(out); // the files of one sweep stand together
    const std::filesystem::path records = out / "sweep.jsonl", page = out / "sweep.md", chart = out / "sweep.svg";
    writeRecords(records, result.records);
    const std::string table = report::viewportTable(result.records);
    writeFile(page, fmt::format("# {} over {}\n\n{}\n![frame times](sweep.svg)\n", result.records.front().scene,
                                options.axis, table));
    writeFile(chart, report::viewportChart(result.records));
    fmt::print("{}\nrecords: {}\npage: {}\nchart: {}\n", table, records.string(), page.string(), chart.string());
    return result.code;
}

ExitCode sweepAndPrint(const SweepOptions& options, const std::filesystem::path& out) {
    if (options.axis == lod::viewportAxis) return viewportsAndPrint(options, out);
    const SweepResult result = sweep(options);
    const OutputLock alone(out);
    const std::filesystem::path records = out / "sweep.jsonl", page = out / "sweep.md", chart = out / "sweep.svg";
    writeRecords(records, result.records);
    const std::string table = report::sweepTable(result.records);
    const auto svg = report::sweepChart(result.records, axisNamed(options.axis).logarithmic);
    writeFile(page, fmt::format("# {} over {}\n\n{}{}", result.records.front().scene, options.axis, table,
                                svg ? "\n![error curves](sweep.svg)\n" : ""));
    if (svg) writeFile(chart, *svg);
    fmt::print("{}\n", table);
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} at {:g}: {}\n", record.variant, record.sweep->value, record.reason);
    fmt::print("records: {}\npage: {}\n", records.string(), page.string());
    if (svg) fmt::print("chart: {}\n", chart.string());
    return result.code;
}

std::string axesHelp() {
    std::string text = "Axes, with their own values in the order in which a break is looked for:\n";
    for (const Axis& axis : axes())
        text += fmt::format("  {:<20} {}{}\n{:23}{}\n", axis.id, axis.meaning, axis.unit.empty() ? "" : ", in " + axis.unit,
                            "", fmt::join(axis.values, ", "));
    return text +
           fmt::format("  {:<20} side of the picture of lod-* techniques, in pixels: their cost\n", lod::viewportAxis);
}

} // namespace

void addSweep(CLI::App& app, Action& action) {
    const auto options = std::make_shared<SweepOptions>();
    const auto profile = std::make_shared<std::string>("gate");
    const auto out = std::make_shared<std::filesystem::path>("results/sweep");
    CLI::App* verb = app.add_subcommand("sweep", "Moves one quantity of a scene and shows where techniques break");
    verb->footer(axesHelp() +
                 "Examples:\n  shadowbench sweep --scene dueling-frusta --axis light-view-angle --technique 'sm-*'\n"
                 "  shadowbench sweep --scene windmills --axis viewport --technique 'lod-*' --profile standard\n"
                 "  shadowbench sweep --scene dueling-frusta --axis map --values 2048,1024,512 --technique sm-uniform");
    verb->add_option("--scene", options->scene, "Scene id or file")->required();
    verb->add_option("--axis", options->axis, "What is moved")->required();
    verb->add_option("--values", options->values,
                     "Comma-separated, in the order in which a break is looked for (default: the axis' own, below)")
        ->delimiter(',');
    verb->add_option("--technique", options->techniques,
                     "Variant such as pcss:taps=32+32, or a glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, options->techniques);
    addProfileOption(*verb, *profile);
    verb->add_option("--out", *out, "Folder of sweep.jsonl, sweep.md and sweep.svg")->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addSeedOption(*verb, options->seed);
    addGlOption(*verb);
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, profile, out] {
        action = [options, profile, out] {
            options->profile = profileNamed(*profile);
            return sweepAndPrint(*options, *out);
        };
    });
}

} // namespace shadowbench
