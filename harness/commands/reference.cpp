#include "groundtruth/reference.h"

#include "groundtruth/reference_files.h"
#include "harness/commands/command.h"
#include "harness/run/progress_line.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

struct ReferenceOptions {
    std::string scene;
    std::string profile = "gate";
    std::string oracle = "auto";
    int frame = -1;  // −1: the scored one
    int samples = 0; // 0: the scene's own
    bool quiet = false;
    std::filesystem::path out = "results/latest/reference";
};

ExitCode computeOne(const ReferenceOptions& options) {
    const Scene scene = loadScene(options.scene, profileNamed(options.profile));
    const int last = scene.timeline.frames() - 1;
    const int frame = options.frame < 0 ? scene.timeline.still - 1 : options.frame;
    if (frame > last)
        throw BadInput(fmt::format("scene {} has frames 0 to {}; --frame {} is not one of them", scene.id, last, frame));
    const groundtruth::Request request{snapshot(scene, frame), scene.size, groundtruth::oracleNamed(options.oracle),
                                       options.samples > 0 ? options.samples : scene.referenceSamples};
    ProgressLine line(scene.id, 1, options.quiet);
    const groundtruth::Reference computed =
        groundtruth::compute(request, [&](double share, std::string_view what) { line.show(0, share, what); });
    line.show(1, 0, "");
    groundtruth::writeReference(computed, options.out);
    fmt::print("{} frame {} by {}: {}\n", scene.id, frame, computed.provenance.oracle,
               (options.out / "visibility.exr").string());
    return ExitCode::Pass;
}

} // namespace

void addReference(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ReferenceOptions>();
    CLI::App* verb = app.add_subcommand("reference", "Computes the ground truth of one frame");
    verb->footer("Example:\n  shadowbench reference --scene overlapping-occluders --samples 256 --out /tmp/truth");
    verb->add_option("--scene", options->scene, "Scene id or file")->required();
    verb->add_option("--frame", options->frame, "Frame number (default: the scored one)")->check(CLI::NonNegativeNumber);
    verb->add_option("--oracle", options->oracle, "auto, polygon, rays or povray")->capture_default_str();
    verb->add_option("--samples", options->samples, "Light samples of an area light (default: the scene's)")
        ->check(CLI::Range(4, 16384));
    verb->add_option("--profile", options->profile, "gate, standard or paper")->capture_default_str();
    verb->add_option("--out", options->out, "Folder for visibility.exr and provenance.json")->capture_default_str();
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options] { action = [options] { return computeOne(*options); }; });
}

} // namespace shadowbench
