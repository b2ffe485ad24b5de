#include "cli/options.h"

#include "base/one_line.h"
#include "techniques/catalog.h"
#include "techniques/folder/description.h"
#include "techniques/gl/platform.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>

namespace shadowbench {

void addProfileOption(CLI::App& verb, std::string& profile) {
    verb.add_option("--profile", profile, "Size of pictures and length of timelines")
        ->type_name("TEXT:{gate,standard,paper}")
        ->capture_default_str();
}

void addGlOption(CLI::App& verb) {
    verb.add_option_function<std::string>(
            "--gl", [](const std::string& word) { gl::choosePlatform(gl::platformNamed(word)); },
            "What draws: auto (in software, the same everywhere: OSMesa, else EGL), osmesa, or egl (a graphics processor, "
            "else in software) (default: $SHADOWBENCH_GL or auto)")
        ->check(CLI::IsMember({"auto", "osmesa", "egl"}));
}

void addTechniqueFolderOption(CLI::App& verb, std::vector<std::string>& techniques) {
    verb.add_option_function<std::vector<std::filesystem::path>>(
        "--technique-folder",
        [&techniques](const std::vector<std::filesystem::path>& folders) {
            for (const std::filesystem::path& folder : folders) techniques::addTechniqueFolder(folder);
            if (techniques.empty()) techniques = {std::string(techniques::folderPrefix) + "*"};
        },
        "Folder that is a technique of your own, my:ID (docs/technique-folders.md); repeatable; without --technique only "
        "its "
        "rows run");
}

void addTechniqueFolderOption(CLI::App& verb) {
    verb.add_option_function<std::vector<std::filesystem::path>>(
        "--technique-folder",
        [](const std::vector<std::filesystem::path>& folders) {
            for (const std::filesystem::path& folder : folders) techniques::addTechniqueFolder(folder);
        },
        "Folder that is a technique of your own, my:ID (docs/technique-folders.md); repeatable");
}

void warnOfFolders() {
    for (const std::string& line : techniques::unusedInFolders()) fmt::print(stderr, "warning: {}\n", onOneLine(line));
}

void addStaticOption(CLI::App& verb, bool& standing) {
    verb.add_flag("--static", standing,
                  "Costs are of scenes where light and casters stand still: with what techniques keep from frame to frame "
                  "(default: the dearer of standing and in motion)");
}

void addSeedOption(CLI::App& verb, std::uint32_t& seed) {
    verb.add_option("--seed", seed, "Seed of pseudo-random choices")->check(CLI::Range(1U, 100000U))->capture_default_str();
}

std::vector<Record> recordsAt(const std::filesystem::path& place) {
    return readRecords(std::filesystem::is_directory(place) ? place / "results.jsonl" : place);
}

} // namespace shadowbench
