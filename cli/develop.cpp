#include "studies/develop/develop.h"

#include "base/error.h"
#include "base/shell_word.h"
#include "cli/command.h"
#include "cli/options.h"
#include "groundtruth/store/cache.h"
#include "scene/load/load.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

/// The words with which `run` shows the same again.
std::string commandFor(const develop::Request& request) {
    std::vector<std::string> words{"shadowbench"};
    for (const std::string& word : develop::runWords(request)) words.push_back(shellWord(word));
    return fmt::format("{}", fmt::join(words, " "));
}

/// As seen from any folder.
std::string sceneFromAnywhere(const std::string& scene) {
    const std::vector<std::string> known = builtinScenes();
    return std::ranges::find(known, scene) != known.end() || !fs::exists(scene) ? scene : fs::absolute(scene).string();
}

ExitCode developAndPrint(develop::Request request, const std::string& profile) {
    if (!fs::is_directory(request.folder))
        throw BadInput(
            fmt::format("there is no technique folder {}; shadowbench new-technique makes one", request.folder.string()));
    request.folder = fs::canonical(request.folder);
    request.profile = profileNamed(profile);
    if (request.cache.empty()) request.cache = groundtruth::defaultCacheFolder();
    request.cache = fs::absolute(request.cache);
    for (std::string& scene : request.scenes) scene = sceneFromAnywhere(scene);
    develop::develop(request, commandFor(request), [](int chosen) {
        fmt::print("page: http://127.0.0.1:{}/\nEach save of the folder is drawn; Ctrl-C ends.\n", chosen);
        std::fflush(stdout);
    });
    return ExitCode::Pass;
}

} // namespace

void addDevelop(CLI::App& app, Action& action) {
    const auto request = std::make_shared<develop::Request>();
    const auto profile = std::make_shared<std::string>("gate");
    request->scenes = {"simple"};
    CLI::App* verb = app.add_subcommand("develop", "Shows a technique folder on a page, anew at each save of its files");
    verb->footer(
        "Examples:\n  shadowbench develop evsm\n  shadowbench develop evsm --scene windmills --scene my.toml\n"
        "  shadowbench develop evsm --technique my:evsm:map=512 --technique my:evsm:map=2048\n"
        "Open the page that it names in a browser of this machine. k keeps a state, c shows the kept one in turn with\n"
        "the current one, y copies the command that runs it again. More: docs/technique-folders.md");
    verb->add_option("folder", request->folder, "Folder with a technique.toml and its shaders")->required();
    verb->add_option("--scene", request->scenes, "Scene id or file; repeatable")->capture_default_str();
    verb->add_option("--technique", request->techniques,
                     "Variant such as my:evsm:map=512; repeatable (default: all rows of the folder)");
    addProfileOption(*verb, *profile);
    verb->add_option("--cache", request->cache,
                     "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    addGlOption(*verb);
    verb->callback(
        [&action, request, profile] { action = [request, profile] { return developAndPrint(*request, *profile); }; });
}

} // namespace shadowbench
