#include "scene/exchange/export.h"

#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

struct ExportOptions {
    std::string scene;
    std::filesystem::path out;
    std::string profile = "gate";
    bool json = false;
    bool quiet = false;
};

ExitCode exportAndPrint(const ExportOptions& options) {
    const Scene scene = loadScene(options.scene, profileNamed(options.profile), metrics::boundedMetrics());
    const OutputLock alone(options.out);
    const exchange::Exported exported = exchange::exportScene(scene, options.out);
    if (options.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"scene", scene.id},
                                                  {"profile", options.profile},
                                                  {"folder", options.out.string()},
                                                  {"frames", exported.frames},
                                                  {"files", exported.files}}
                               .dump(2));
    else if (!options.quiet)
        fmt::print("{}: frames {} in {}: {}\n", scene.id, fmt::join(exported.frames, ", "), options.out.string(),
                   fmt::join(exported.files, ", "));
    return ExitCode::Pass;
}

} // namespace

void addExport(CLI::App& app, Action& action) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App* verb = app.add_subcommand("export", "Writes a scene for other renderers: glTF, OBJ, JSON");
    verb->footer("The format: docs/exchange.md. The folder is a scene again: shadowbench run --scene exported\n"
                 "Examples:\n  shadowbench export stacked-plates --out exported\n"
                 "  shadowbench export my-scene.toml --out exported --profile paper");
    verb->add_option("SCENE", options->scene, "Scene id or file")->required();
    verb->add_option("--out", options->out, "Folder of the files: a new or empty one, or that of an earlier export")
        ->required();
    addProfileOption(*verb, options->profile);
    verb->add_flag("--json", options->json, "For machines");
    verb->add_flag("--quiet", options->quiet, "Print nothing");
    verb->callback([&action, options] { action = [options] { return exportAndPrint(*options); }; });
}

} // namespace shadowbench
