#include "harness/inspect/inspection.h"

#include "base/folder_lock.h"
#include "base/image_io.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace shadowbench {
namespace {

struct InspectOptions {
    std::vector<std::string> scenes;
    std::filesystem::path out = "results/latest/inspect";
    std::string profile = "gate";
    bool json = false;
};

ExitCode inspectAndPrint(const InspectOptions& options) {
    const OutputLock alone(options.out);
    std::vector<std::string> blocks;
    for (const std::string& name : options.scenes) {
        const Scene scene = loadScene(name, profileNamed(options.profile), metrics::boundedMetrics());
        const inspect::Inspection found = inspect::inspect(scene);
        const std::filesystem::path picture = options.out / (scene.id + ".png");
        writePng(picture, found.picture);
        blocks.push_back(options.json ? inspect::jsonOf(found, picture.string()) : inspect::textOf(found, picture.string()));
    }
    if (options.json)
        fmt::print("[{}]\n", fmt::join(blocks, ",\n"));
    else
        fmt::print("{}", fmt::join(blocks, "\n"));
    return ExitCode::Pass;
}

} // namespace

void addInspect(CLI::App& app, Action& action) {
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* verb = app.add_subcommand(
        "inspect", "Shows what a scene is: a picture, sizes, faults of its meshes, what is lit, and what looks wrong");
    verb->footer("Exit code 0 with warnings, too, each with what to do about it; 2 for a scene that cannot be used.\n"
                 "Examples:\n  shadowbench inspect my-scene.toml\n"
                 "  shadowbench inspect simple windmills --profile standard --out /tmp/pictures\n"
                 "  shadowbench inspect my-scene.toml --json");
    verb->add_option("SCENE", options->scenes, "Scene ids or files")->required();
    addProfileOption(*verb, options->profile);
    verb->add_option("--out", options->out, "Folder of the pictures, SCENE.png")->capture_default_str();
    verb->add_flag("--json", options->json, "For machines: a list with an object for each scene");
    verb->callback([&action, options] { action = [options] { return inspectAndPrint(*options); }; });
}

} // namespace shadowbench
