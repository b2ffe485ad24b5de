// The command line: parses, calls, prints. One function a verb.
#include "groundtruth/cache.h"
#include "groundtruth/reference.h"
#include "groundtruth/reference_files.h"
#include "harness/report/report.h"
#include "harness/run/catalogues.h"
#include "harness/run/progress_line.h"
#include "harness/run/run.h"
#include "harness/scene/files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

/// Scene ids in the order of the records.
std::vector<std::string> scenesOf(const std::vector<Record>& records) {
    std::vector<std::string> scenes;
    for (const Record& record : records)
        if (std::find(scenes.begin(), scenes.end(), record.scene) == scenes.end()) scenes.push_back(record.scene);
    return scenes;
}

int printRun(const RunResult& result, const RunOptions& options) {
    const report::Written written = report::writeReport(result.records, options.out);
    for (const std::string& scene : scenesOf(result.records))
        fmt::print("{}\n", report::terminalTable(result.records, scene));
    for (const Record& record : result.records)
        if (record.status == Status::Error)
            fmt::print(stderr, "error: {} on {}: {}\n", record.variant, record.scene, record.reason);
    fmt::print("records: {}\npage: {}\n", (options.out / "results.jsonl").string(), written.page.string());
    for (const fs::path& chart : written.charts) fmt::print("chart: {}\n", chart.string());
    return static_cast<int>(result.code);
}

struct ReferenceOptions {
    std::string scene;
    std::string profile = "gate";
    std::string oracle = "auto";
    int frame = -1;  // −1: the scored one
    int samples = 0; // 0: the scene's own
    bool quiet = false;
    fs::path out = "results/reference";
};

int reference(const ReferenceOptions& options) {
    const Scene scene = loadScene(options.scene, profileNamed(options.profile));
    const int last = scene.timeline.frames() - 1;
    const int frame = options.frame < 0 ? scene.timeline.still - 1 : options.frame;
    if (frame > last)
        throw BadInput(fmt::format("scene {} has frames 0 to {}; --frame {} is not one of them", scene.id, last, frame));
    groundtruth::Request request{snapshot(scene, frame), scene.size, groundtruth::oracleNamed(options.oracle),
                                 options.samples > 0 ? options.samples : scene.referenceSamples};
    ProgressLine line(scene.id, 1, options.quiet);
    const groundtruth::Reference computed =
        groundtruth::compute(request, [&](double share, std::string_view what) { line.show(0, share, what); });
    line.show(1, 0, "");
    groundtruth::writeReference(computed, options.out);
    fmt::print("{} frame {} by {}: {}\n", scene.id, frame, computed.provenance.oracle,
               (options.out / "visibility.exr").string());
    return static_cast<int>(ExitCode::Pass);
}

int makeReport(const fs::path& records, const fs::path& out) {
    const report::Written written = report::writeReport(readRecords(records), out);
    fmt::print("page: {}\n", written.page.string());
    for (const fs::path& chart : written.charts) fmt::print("chart: {}\n", chart.string());
    return static_cast<int>(ExitCode::Pass);
}

void addRun(CLI::App& app, RunOptions& options, std::string& profile) {
    CLI::App* verb = app.add_subcommand("run", "Renders and scores cells: scenes × techniques");
    verb->footer("Examples:\n  shadowbench run\n  shadowbench run --scene dueling-frusta --technique 'sm-*' --technique "
                 "volume-zfail\n"
                 "  shadowbench run --scene my.toml --technique pcss:taps=32+32,map=2048 --profile standard --images --out "
                 "results/mine");
    verb->add_option("--scene", options.scenes, "Scene id or file; repeatable (default: the standard scenes)");
    verb->add_option("--technique", options.techniques,
                     "Variant such as pcss:taps=32+32, or a glob over ids; repeatable (default: all)");
    verb->add_option("--profile", profile, "gate, standard or paper")->capture_default_str();
    verb->add_option("--out", options.out, "Folder of records and report")->capture_default_str();
    verb->add_option("--cache", options.cache, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_option("--seed", options.seed, "Seed of pseudo-random choices")
        ->check(CLI::Range(1U, 100000U))
        ->capture_default_str();
    verb->add_flag("--resume", options.resume, "Keep the cells that --out already holds, run the rest");
    verb->add_flag("--images", options.images, "Write visibility, reference and error of each cell as EXR and PNG");
    verb->add_flag("!--no-time", options.time, "Leave out wall times: the records of two runs are then equal");
    verb->add_flag("--quiet", options.quiet, "No progress");
}

void addReference(CLI::App& app, ReferenceOptions& options) {
    CLI::App* verb = app.add_subcommand("reference", "Computes the ground truth of one frame");
    verb->footer("Example:\n  shadowbench reference --scene overlapping-occluders --samples 256 --out /tmp/truth");
    verb->add_option("--scene", options.scene, "Scene id or file")->required();
    verb->add_option("--frame", options.frame, "Frame number (default: the scored one)")->check(CLI::NonNegativeNumber);
    verb->add_option("--oracle", options.oracle, "auto, polygon, rays or povray")->capture_default_str();
    verb->add_option("--samples", options.samples, "Light samples of an area light (default: the scene's)")
        ->check(CLI::Range(4, 16384));
    verb->add_option("--profile", options.profile, "gate, standard or paper")->capture_default_str();
    verb->add_option("--out", options.out, "Folder for visibility.exr and provenance.json")->capture_default_str();
    verb->add_flag("--quiet", options.quiet, "No progress");
}

/// CLI11 says "was not expected" of a misspelt verb; a person wants the near matches.
void requireKnownVerb(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return;
    std::string all;
    for (const std::string& verb : verbs) all += (all.empty() ? "" : ", ") + verb;
    throw BadInput(fmt::format("there is no verb \"{}\"{}; the verbs are: {}", argv[1], didYouMean(argv[1], verbs), all));
}

int dispatch(int argc, char** argv) {
    CLI::App app("shadowbench scores real-time shadow techniques against proven ground truth.", "shadowbench");
    app.require_subcommand(1);
    app.set_version_flag("--version", "shadowbench 0.1.0");
    app.footer(
        "Exit codes: 0 pass, 1 internal, 2 usage or bad input, 3 cost regression, 4 accuracy or stability regression, "
        "5 inconclusive.\nEvery verb has --help with an example.");

    std::string what = "techniques", format = "text";
    CLI::App* list = app.add_subcommand("list", "Lists techniques with their parameters, scenes or metrics");
    list->footer("Example:\n  shadowbench list techniques --format md");
    list->add_option("what", what, "techniques, scenes or metrics")
        ->check(CLI::IsMember({"techniques", "scenes", "metrics"}));
    list->add_option("--format", format, "text, md or json")
        ->check(CLI::IsMember({"text", "md", "json"}))
        ->capture_default_str();

    RunOptions runOptions;
    std::string profile = "gate";
    addRun(app, runOptions, profile);
    ReferenceOptions referenceOptions;
    addReference(app, referenceOptions);

    fs::path records = "results/latest/results.jsonl", reportFolder;
    CLI::App* reportVerb = app.add_subcommand("report", "Renders records as tables, charts and a page");
    reportVerb->footer("Example:\n  shadowbench report results/latest/results.jsonl --out results/published");
    reportVerb->add_option("records", records, "results.jsonl")->capture_default_str();
    reportVerb->add_option("--out", reportFolder, "Folder to write into (default: that of the records)");

    requireKnownVerb(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        throw BadInput(error.what());
    }
    if (*list) {
        fmt::print("{}", catalogue(what, format));
        return static_cast<int>(ExitCode::Pass);
    }
    if (app.got_subcommand("run")) {
        runOptions.profile = profileNamed(profile);
        return printRun(run(runOptions), runOptions);
    }
    if (app.got_subcommand("reference")) return reference(referenceOptions);
    return makeReport(records, reportFolder.empty() ? records.parent_path() : reportFolder);
}

} // namespace
} // namespace shadowbench

int main(int argc, char** argv) {
    try {
        return shadowbench::dispatch(argc, argv);
    } catch (const shadowbench::Error& error) {
        fmt::print(stderr, "shadowbench: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "shadowbench: internal error: {}\n", error.what());
        return static_cast<int>(shadowbench::ExitCode::Internal);
    }
}
