#include "scene/exchange/export.h"

#include "base/folder_lock.h"
#include "base/progress_line.h"
#include "cli/command.h"
#include "cli/options.h"
#include "harness/cells/written_truths.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "techniques/gl/context.h"

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
    bool truth = false;
    std::filesystem::path cache;
    bool json = false;
    bool quiet = false;
};

/// The truths' files, by their names in the folder of the export.
std::vector<std::string> exportTruths(const Scene& scene, const ExportOptions& options) {
    const groundtruth::Cache cache(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache);
    Truths truths(scene, cache);
    ProgressLine line(scene.id, 1, options.quiet || options.json);
    const auto context = gl::Context::create();
    SceneFrames frames(scene, truths);
    std::vector<std::string> files =
        writeTruths(frames, options.out / "truth", [&](double share, std::string_view what) { line.show(0, share, what); });
    for (std::string& file : files) file = "truth/" + file;
    return files;
}

ExitCode exportAndPrint(const ExportOptions& options) {
    const Scene scene = loadScene(options.scene, profileNamed(options.profile), metrics::boundedMetrics());
    const OutputLock alone(options.out);
    exchange::Exported exported = exchange::exportScene(scene, options.out);
    removeTruths(options.out / "truth"); // of another state of the scene, maybe
    if (options.truth)
        for (std::string& file : exportTruths(scene, options)) exported.files.push_back(std::move(file));
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
    verb->footer(
        "The format: docs/exchange.md. The folder is a scene again: shadowbench run --scene exported\n"
        "Examples:\n  shadowbench export stacked-plates --out exported\n"
        "  shadowbench export my-scene.toml --out exported --profile paper\n"
        "  shadowbench export stacked-plates --out exported --truth      (and what is true, as EXR: exported/truth)");
    verb->add_option("SCENE", options->scene, "Scene id or file")->required();
    verb->add_option("--out", options->out, "Folder of the files: a new or empty one, or that of an earlier export")
        ->required();
    addProfileOption(*verb, options->profile);
    verb->add_flag("--truth", options->truth, "Also the truths of every frame, into truth/ of the folder: EXR and JSON");
    verb->add_option("--cache", options->cache,
                     "Folder of references for --truth (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_flag("--json", options->json, "For machines");
    verb->add_flag("--quiet", options->quiet, "Print nothing");
    verb->callback([&action, options] { action = [options] { return exportAndPrint(*options); }; });
}

} // namespace shadowbench
