#include "cli/reference.h"

#include "base/folder_lock.h"
#include "base/progress_line.h"
#include "cli/command.h"
#include "cli/options.h"
#include "groundtruth/cgal/hard/exact.h"
#include "groundtruth/cgal/plan/polygon_files.h"
#include "groundtruth/contract/reference_files.h"
#include "groundtruth/store/golden.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <map>
#include <memory>

namespace shadowbench {
namespace {

/// The command line's own words, checked by `resolved`.
struct ReferenceWords {
    ReferenceOptions options;
    std::string profile = "gate";
    std::string truth;
    int frame = -1; // −1: not named
    bool verify = false;
    bool accept = false;
    bool certify = false;
};

/// The oracle named the truth, too, before --truth did.
void renameFormerOracle(ReferenceWords& words) {
    static const std::map<std::string, std::string> now{
        {"area", "area"}, {"povray", "soft"}, {"irradiance", "irradiance"}, {"solid-angle", "solid-angle"}};
    const auto found = now.find(words.options.oracle);
    if (found == now.end()) return;
    if (!words.truth.empty()) throw BadInput(fmt::format("--truth says what is asked: leave out --oracle {}", found->first));
    fmt::print(stderr, "shadowbench: --oracle {} is now called --truth {}\n", found->first, found->second);
    words.truth = found->second;
    words.options.oracle = "auto";
}

ReferenceOptions resolved(ReferenceWords words) {
    renameFormerOracle(words);
    ReferenceOptions options = words.options;
    options.profile = profileNamed(words.profile);
    if (!words.truth.empty()) options.truth = truthNamed(words.truth);
    if (words.frame >= 0) options.frame = words.frame;
    return options;
}

ExitCode run(const ReferenceWords& words) {
    const ReferenceOptions options = resolved(words);
    if (words.verify) return verifyGoldenReferences(options);
    if (words.accept) return acceptGoldenReferences(options);
    if (!options.report.empty()) return reportOnTruth(options);
    if (words.certify && options.truth)
        throw BadInput("--certify is of POV-Ray's render and --truth names another reference: leave one of them out");
    if (words.certify) return certifyReference(options);
    return computeReference(options);
}

/// The exact shadow polygons of every planar receiver; of the plan oracle what the light sees of it, too.
void printPolygons(const groundtruth::Request& request, const std::filesystem::path& folder) {
    const groundtruth::PrimaryHits primary = groundtruth::hard::primaryHits(request.snapshot, request.size);
    std::vector<std::filesystem::path> files = groundtruth::plan::writeShadowPolygons(request.snapshot, primary, folder);
    if (request.oracle == groundtruth::Oracle::Plan)
        for (std::filesystem::path& file : groundtruth::plan::writeVisiblePolygons(request.snapshot, primary, folder))
            files.push_back(std::move(file));
    for (const std::filesystem::path& file : files) fmt::print("polygons: {}\n", file.string());
}

/// By the truth that the options name, else the one that the oracle is of, else the usual one of the light.
groundtruth::Request chosenRequest(const Scene& scene, int frame, const ReferenceOptions& options) {
    const groundtruth::Oracle oracle = groundtruth::oracleNamed(options.oracle);
    const Truth usual = oracle == groundtruth::Oracle::Auto ? groundtruth::usualTruth(scene.light) : Truth::Hard;
    groundtruth::Request request = referenceRequest(scene, options.truth.value_or(usual), frame);
    if (request.truth != Truth::Hard && oracle != groundtruth::Oracle::Auto)
        throw BadInput(fmt::format("--oracle {} finds hard labels, and --truth asks for {}: leave out --oracle",
                                   options.oracle, name(request.truth)));
    request.oracle = oracle;
    return request;
}

} // namespace

int frameOf(const Scene& scene, const ReferenceOptions& options) {
    const int last = scene.timeline.frames() - 1;
    const int frame = options.frame.value_or(scene.timeline.still - 1);
    if (frame > last)
        throw BadInput(fmt::format("scene {} has frames 0 to {}; --frame {} is not one of them", scene.id, last, frame));
    return frame;
}

NamedRequest requestOf(const ReferenceOptions& options) {
    if (options.scenes.size() != 1) throw BadInput("a reference is of one scene: name it with --scene");
    const Scene scene = loadScene(options.scenes.front(), options.profile, metrics::boundedMetrics());
    const int frame = frameOf(scene, options);
    NamedRequest named{scene.id, frame, chosenRequest(scene, frame, options)};
    if (options.samples > 0) named.request.samples = options.samples;
    return named;
}

ExitCode computeReference(const ReferenceOptions& options) {
    const NamedRequest named = requestOf(options);
    ProgressLine line(named.scene, 1, options.quiet);
    const groundtruth::Reference computed =
        groundtruth::compute(named.request, [&](double share, std::string_view what) { line.show(0, share, what); });
    line.show(1, 0, "");
    requireGolden(committedContents(), computed.provenance.key, contentOf(contentHashes(computed)));
    const OutputLock alone(options.out);
    groundtruth::writeReference(computed, options.out);
    fmt::print("{} frame {} by {}: {}\n", named.scene, named.frame, computed.provenance.oracle,
               (options.out / "visibility.exr").string());
    if (options.polygons) printPolygons(named.request, options.out);
    return ExitCode::Pass;
}

void addReference(CLI::App& app, Action& action) {
    const auto words = std::make_shared<ReferenceWords>();
    ReferenceOptions& options = words->options;
    CLI::App* verb = app.add_subcommand(
        "reference", "Computes the ground truth of a frame, verifies the golden references, reports on the truth");
    verb->footer(
        "Golden references are those that a run of the gate profile asks for; results/reference/lock.json says what "
        "they are.\n--verify ends with 0 if they are still the same, 4 if not, 5 if a tool is missing.\n"
        "Examples:\n  shadowbench reference --scene overlapping-occluders --samples 256 --out /tmp/truth\n"
        "  shadowbench reference --scene colonnade --oracle plan --polygons --out /tmp/plan\n"
        "  shadowbench reference --scene overlapping-occluders --certify --points 10000\n"
        "  shadowbench reference --scene simple --truth irradiance --out /tmp/irradiance\n"
        "  shadowbench reference --verify --truth hard\n  shadowbench reference --accept --scene simple\n"
        "  shadowbench reference --report results/truth");
    verb->add_option("--scene", options.scenes,
                     "Scene id or file; with --verify, --accept and --report repeatable (default: the standard scenes, and "
                     "of golden references those that the gate judges beside them)");
    verb->add_option("--frame", words->frame, "Frame number (default: the scored one; of golden references all)")
        ->check(CLI::NonNegativeNumber);
    CLI::Option* oracle = verb->add_option("--oracle", options.oracle, "What finds hard labels: auto, polygon, rays or plan")
                              ->capture_default_str();
    CLI::Option* samples = verb->add_option("--samples", options.samples,
                                            "Samples of an area light, directions of a sky (default: the scene's)")
                               ->check(CLI::Range(4, 16384));
    addProfileOption(*verb, words->profile);
    CLI::Option* out =
        verb->add_option("--out", options.out, "Folder for visibility.exr and provenance.json")->capture_default_str();
    CLI::Option* polygons =
        verb->add_flag("--polygons", options.polygons, "Also the exact shadow polygons of planar receivers, as WKT and SVG");
    CLI::Option* certify = verb->add_flag(
        "--certify", words->certify,
        "Measure POV-Ray's error on the frame against the exact visible fraction, or exact directions of a sky; see "
        "--points");
    CLI::Option* points =
        verb->add_option("--points", options.points, "Pixels that --certify compares")->check(CLI::Range(32, 1 << 24));
    points->capture_default_str()->needs(certify);
    CLI::Option* verify = verb->add_flag("--verify", words->verify, "Compute the golden references again and compare");
    CLI::Option* accept =
        verb->add_flag("--accept", words->accept, "Compute the golden references again, say what changed, and keep them");
    verb->add_option(
        "--truth", words->truth,
        "The truth to compute: hard, soft, pixel-area, area, irradiance or solid-angle (default: soft where the "
        "light has an area, else hard); with --verify and --accept, golden references of that truth only");
    verb->add_option("--golden", options.golden, "Folder of the golden references")->capture_default_str();
    verb->add_flag("--json", options.json, "What --verify, --accept and --certify found, for machines");
    verb->add_flag("--quiet", options.quiet, "No progress");
    CLI::Option* report = verb->add_option("--report", options.report,
                                           "Folder for pages on the truth: images, uncertainty, agreement of oracles");
    verb->add_option("--cache", options.cache,
                     "Folder of references for --report (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    for (CLI::Option* mode : {verify, accept, report})
        mode->excludes(oracle)->excludes(samples)->excludes(out)->excludes(polygons)->excludes(certify);
    certify->excludes(oracle)->excludes(out)->excludes(polygons);
    verify->excludes(accept)->excludes(report);
    accept->excludes(report);
    verb->callback([&action, words] { action = [words] { return run(*words); }; });
}

} // namespace shadowbench
