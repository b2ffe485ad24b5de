// The clients' lists of renderers can be read, and start what is there. Nothing is installed or rendered here: Chromium and
// Blender run by the clients' own commands.
#include "base/files.h"
#include "harness/foreign/expected_failures.h"
#include "harness/foreign/renderer.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;

const fs::path clients = fs::path(SOURCE_FOLDER) / "clients";

/// The folders that have a `render`.
std::vector<fs::path> clientFolders() {
    std::vector<fs::path> folders;
    for (const fs::directory_entry& entry : fs::directory_iterator(clients))
        if (fs::exists(entry.path() / "client.toml")) folders.push_back(entry.path());
    std::ranges::sort(folders);
    return folders;
}

std::vector<Renderer> renderersIn(const fs::path& folder) { return readRenderers(folder / "client.toml"); }

/// The same text, or the same number written otherwise (0.0001, 1e-04).
bool isSame(const std::string& a, const std::string& b) {
    char* end = nullptr;
    const double number = std::strtod(a.c_str(), &end);
    return a == b || (end != a.c_str() && *end == '\0' && number == std::strtod(b.c_str(), nullptr));
}

bool isExecutable(const fs::path& file) {
    return (fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms::none;
}

TEST(Clients, AreThoseOfTheirPage) {
    std::vector<std::string> names;
    for (const fs::path& folder : clientFolders()) names.push_back(folder.filename());
    EXPECT_EQ(names, (std::vector<std::string>{"babylonjs", "blender", "filament", "godot", "ogl", "ogre", "openscenegraph",
                                               "playcanvas", "threejs", "vtk"}));
}

TEST(Clients, SayWhoseTheyAre) {
    for (const fs::path& folder : clientFolders()) {
        const auto client = readClient(folder / "client.toml");
        ASSERT_TRUE(client) << folder;
        for (const Renderer& renderer : renderersIn(folder)) {
            const bool saysSize = std::regex_search(renderer.id, std::regex("-(1024|2048|4096)$"));
            EXPECT_EQ(renderer.division == Division::EqualMaps, saysSize && renderer.division != Division::Tuned)
                << renderer.id;
        }
    }
}

/// Those of `check`, each of a row that is there.
TEST(Clients, ExpectFailuresOfTheirRows) {
    const std::set<std::string> scenes{"hands", "sun", "moving", "contact", "sheets", "soft"};
    for (const fs::path& folder : clientFolders())
        for (const ExpectedFailure& failure : readExpectedFailures(folder / "client.toml")) {
            EXPECT_TRUE(scenes.contains(failure.scene)) << failure.where;
            EXPECT_TRUE(std::ranges::any_of(renderersIn(folder), [&](const Renderer& renderer) {
                return failure.covers(failure.scene, renderer.id);
            })) << failure.where;
        }
}

/// Their last scores stand with the reason why there are no newer ones.
TEST(Clients, RulesNameTheRetiredOnes) {
    const std::string rules = readFile(fs::path(SOURCE_FOLDER) / "docs" / "scoreboard.md");
    for (const fs::path& folder : clientFolders()) {
        const auto client = readClient(folder / "client.toml");
        EXPECT_TRUE(!client || rules.find(client->retired) != std::string::npos) << folder;
    }
}

TEST(Clients, HaveExecutableCommands) {
    for (const fs::path& folder : clientFolders())
        for (const char* command : {"render", "setup"}) EXPECT_TRUE(isExecutable(folder / command)) << folder << command;
    for (const char* command : {"engines", "blender/definitions"}) EXPECT_TRUE(isExecutable(clients / command)) << command;
}

TEST(Clients, ListRenderersThatStartTheirOwnCommand) {
    std::set<std::string> ids;
    for (const fs::path& folder : clientFolders())
        for (const Renderer& renderer : renderersIn(folder)) {
            EXPECT_TRUE(ids.insert(renderer.id).second) << renderer.id << " is there twice";
            EXPECT_EQ(renderer.command.front(), "./render") << renderer.id;
            EXPECT_FALSE(renderer.title.empty() || renderer.source.empty() || renderer.settings.empty()) << renderer.id;
        }
    EXPECT_GE(ids.size(), 25U);
}

/// A setting that stands in the command stands in the record, too: what was drawn with can be read there.
TEST(Clients, SayEachSettingOfTheirCommands) {
    for (const fs::path& folder : clientFolders())
        for (const Renderer& renderer : renderersIn(folder)) {
            const std::size_t own = 7; // ./render --scene {scene} --frames {frames} --out {out}
            for (std::size_t word = own; word < renderer.command.size(); ++word) {
                const std::string& option = renderer.command[word];
                const std::string value = option.substr(option.find('=') + 1);
                const auto says = [&](const auto& setting) { return isSame(value, setting.second); };
                const bool isInSource = option.starts_with("--engine="); // in the renderer's `source`
                EXPECT_TRUE(isInSource || std::ranges::any_of(renderer.settings, says)) << renderer.id << ": " << option;
            }
        }
}

/// What npm installs is what was committed.
TEST(Clients, PinTheirPackages) {
    for (const char* name : {"threejs", "babylonjs", "playcanvas", "filament"}) {
        const auto package = nlohmann::json::parse(readFile(clients / name / "package.json"));
        const auto lock = nlohmann::json::parse(readFile(clients / name / "package-lock.json"));
        EXPECT_EQ(package.at("dependencies"), lock.at("packages").at("").at("dependencies")) << name;
        for (const auto& [dependency, version] : package.at("dependencies").items())
            EXPECT_EQ(version.get<std::string>().find_first_of("^~*<>"), std::string::npos) << dependency;
    }
}

} // namespace
} // namespace shadowbench::foreign
