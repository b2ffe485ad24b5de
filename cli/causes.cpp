#include "studies/causes/causes.h"

#include "base/files.h"
#include "base/folder_lock.h"
#include "cli/command.h"
#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

ExitCode explainAndPrint(const causes::CausesOptions& options) {
    const OutputLock alone(options.out);
    const causes::CausesResult result = causes::explainAll(options);
    writeFile(options.out / "causes.json", causes::json(result));
    writeFile(options.out / "causes.md", causes::page(result));
    fmt::print("{}page: {}\n", causes::text(result), (options.out / "causes.md").string());
    return result.code;
}

} // namespace

void addCauses(CLI::App& app, Action& action) {
    const auto options = std::make_shared<causes::CausesOptions>();
    const auto profile = std::make_shared<std::string>("gate");
    CLI::App* verb = app.add_subcommand("causes", "Splits the error of rows by cause, pixel by pixel");
    verb->footer(
        "Each cause is removed by an experiment of its own, as far as the technique has one: a settled history, the\n"
        "smallest filter, finer texels, the bias of these, more samples, single casters. What none removes is the\n"
        "method's.\n"
        "Examples:\n  shadowbench causes --scene windmills --technique pcf --technique 'sm-*'\n"
        "  shadowbench causes --scene contact --technique sm-uniform:factor=16\n"
        "  shadowbench causes --scene trees --technique sm-uniform --caster-level 2");
    verb->add_option("--scene", options->scenes, "Scene id or file; repeatable (default: the standard scenes)");
    verb->add_option("--technique", options->techniques,
                     "Variant such as pcf:kernel=7, or a glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, options->techniques);
    verb->add_option("--caster-level", options->casterLevel,
                     "Casters so many levels of detail coarser than their finest, while the truth stays the scene's: what "
                     "they cost is a cause, too (default: as the scene draws them)")
        ->check(CLI::Range(1, 16));
    addProfileOption(*verb, *profile);
    verb->add_option("--out", options->out, "Folder of causes.json, causes.md and a picture of each row")
        ->capture_default_str();
    verb->add_option("--cache", options->cache,
                     "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addSeedOption(*verb, options->seed);
    addGlOption(*verb);
    verb->add_flag("--quiet", options->quiet, "No progress");
    verb->callback([&action, options, profile] {
        action = [options, profile] {
            options->profile = profileNamed(*profile);
            return explainAndPrint(*options);
        };
    });
}

} // namespace shadowbench
