#include "gate/check/check.h"

#include "base/error.h"
#include "base/one_line.h"
#include "cli/command.h"
#include "cli/options.h"
#include "gate/check/client.h"
#include "groundtruth/store/cache.h"
#include "techniques/catalog.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

void print(const gate::CheckResult& result) {
    if (result.what.empty())
        fmt::print("note   {}\n", onOneLine(result.note));
    else if (result.wrong.empty())
        fmt::print("holds  {}{}{}\n", result.what, result.note.empty() ? "" : ": ", result.note);
    else if (result.isExpected)
        fmt::print("known  {}: {} ({})\n", result.what, onOneLine(result.wrong), result.note);
    else
        fmt::print("FAILS  {}: {}\n", result.what, onOneLine(result.wrong));
    std::fflush(stdout); // some take a while
}

} // namespace

void addCheck(CLI::App& app, Action& action) {
    const auto folder = std::make_shared<fs::path>(), cache = std::make_shared<fs::path>();
    CLI::App* verb = app.add_subcommand("check", "Checks what must hold of a technique folder, or of an engine's adapter");
    verb->footer(
        "Example: shadowbench check evsm\n"
        "Draws each row on small scenes at the end of what there is, and its parameters at the ends of their ranges;\n"
        "then judges its expect.toml. A line each; the exit code is 4 where one does not hold.\n"
        "More: docs/technique-folders.md\n"
        "Example: shadowbench check clients/threejs\n"
        "Calls each renderer of its client.toml on six small scenes whose shadows are known, and says what its adapter "
        "does\n"
        "wrong: rows, units, axes, the light's place, matrices, frames, encodings. More: docs/external.md");
    verb->add_option("folder", *folder,
                     "Folder with a technique.toml and its shaders, or with a client.toml; or a list of renderers")
        ->required();
    verb->add_option("--cache", *cache, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addGlOption(*verb);
    verb->callback([&action, folder, cache] {
        const fs::path list = fs::is_regular_file(*folder) ? *folder : *folder / "client.toml";
        if (fs::exists(list)) {
            action = [list] { return gate::checkRenderers(list, print); };
            return;
        }
        if (fs::is_directory(*folder) && !fs::exists(*folder / "technique.toml"))
            throw BadInput(fmt::format("{} holds neither a technique.toml, of a technique, nor a client.toml, of renderers",
                                       folder->string()));
        techniques::addTechniqueFolder(*folder);
        action = [folder, cache] {
            const ExitCode code =
                gate::checkFolder(*folder, cache->empty() ? groundtruth::defaultCacheFolder() : *cache, print);
            warnOfFolders(); // an error is one line, and nothing beside it
            return code;
        };
    });
}

} // namespace shadowbench
