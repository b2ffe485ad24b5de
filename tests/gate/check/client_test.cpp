// `check` of renderers: an exact one holds everywhere, and each mistake that one makes is named.
#include "gate/check/client.h"

#include "base/files.h"
#include "base/temporary_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench::gate {
namespace {

/// What is wrong by row and scene, of renderers that make these mistakes.
std::map<std::string, std::map<std::string, std::string>>
checked(const std::vector<std::pair<std::string, std::string>>& rows) {
    const TemporaryFolder folder;
    std::string list;
    for (const auto& [mistake, definition] : rows)
        list +=
            fmt::format("[[renderer]]\nid = \"{}\"\ndefinition = \"{}\"\ncommand = [\"{}\", \"{{scene}}\", \"{{frames}}\", "
                        "\"{{out}}\", \"{}\", \"{}\"]\n",
                        mistake, definition, DRAWING_CLIENT, mistake, definition);
    writeFile(folder.path() / "external.toml", list);
    std::map<std::string, std::map<std::string, std::string>> wrong;
    checkRenderers(folder.path() / "external.toml", [&](const CheckResult& result) {
        const std::size_t on = result.what.find(" on ");
        wrong[result.what.substr(0, on)][result.what.substr(on + 4)] = result.wrong;
    });
    return wrong;
}

struct Planted {
    const char *mistake, *scene, *says;
};

TEST(ClientCheck, AnExactRendererHoldsOnEachScene) {
    const auto wrong = checked({{"exact", "area"}, {"centre-of-area", "hard"}});
    for (const auto& [row, scenes] : wrong)
        for (const auto& [scene, sentence] : scenes) EXPECT_EQ(sentence, "") << row << " on " << scene;
    EXPECT_EQ(wrong.at("centre-of-area").size(), 6U);
    EXPECT_EQ(wrong.at("exact").size(), 1U); // whose light alone has an area
}

TEST(ClientCheck, NamesTheMistakesOfHardShadows) {
    const Planted all[] = {
        {"rows-bottom-up", "hands", "upside down"},
        {"mirrored", "hands", "mirrored"},
        {"corners", "hands", "it sees pixels through (-0.5, -0.5) beside their centres"},
        {"one-pixel-right", "hands", "looks shifted by (1, 0) pixels"},
        {"inverted", "hands", "inverted"},
        {"shaded", "hands", "shaded picture"},
        {"ambient", "hands", "20 % of the light is left in its shadows"},
        {"second-light", "hands", "50 % of the light is left in its shadows"},
        {"horizontal-angle", "hands", "takes the vertical field of view for the horizontal one"},
        {"half-angle", "hands", "takes the field of view for half of it"},
        {"degrees-for-radians", "hands", "takes degrees for radians"},
        {"light-z", "hands", "its light is mirrored: z has the other sign"},
        {"light-z-up", "hands", "its light has y and z swapped"},
        {"light-negated", "sun", "is black: no receiver has light"},
        {"light-in-centimetres", "hands", "a hundred times as far"},
        {"light-at-eye", "hands", "is its light behind everything, or at the eye?"},
        {"meshes-z", "hands", "its meshes are mirrored: z has the other sign"},
        {"no-matrices", "hands", "their nodes' matrices are ignored"},
        {"no-turn", "hands", "the translation alone is there"},
        {"matrices-by-rows", "hands", "read row by row"},
        {"culls-front", "sheets", "open meshes that face the light are not there"},
        {"culls-back", "sheets", "open meshes that face away from the light are not there"},
        {"first-frame", "moving", "frame 2: its image looks like frame 1"},
        {"old-camera", "moving", "its camera stands still"},
        {"old-light", "moving", "its light stands still"},
        {"old-meshes", "moving", "its moving meshes stand still"},
        {"wrong-bias", "contact", "lit faces shadow themselves"},
        {"large-bias", "contact", "the bias is too large"},
        {"no-shadows", "hands", "shows no shadow"},
    };
    std::vector<std::pair<std::string, std::string>> rows;
    for (const Planted& planted : all) rows.emplace_back(planted.mistake, "hard");
    const auto wrong = checked(rows);
    for (const Planted& planted : all) {
        const std::string& said = wrong.at(planted.mistake).at(planted.scene);
        EXPECT_NE(said.find(planted.says), std::string::npos) << planted.mistake << " on " << planted.scene << ": " << said;
    }
}

TEST(ClientCheck, NamesTheMistakesOfSoftShadows) {
    const Planted all[] = {
        {"srgb", "soft", "sRGB-encoded"},
        {"centre-of-area", "soft", "its images are of the definition \"hard\", not \"area\""},
        {"irradiance", "soft", "its images are of the definition \"irradiance\", not \"area\""},
    };
    std::vector<std::pair<std::string, std::string>> rows;
    for (const Planted& planted : all) rows.emplace_back(planted.mistake, "area");
    const auto wrong = checked(rows);
    for (const Planted& planted : all) {
        const std::string& said = wrong.at(planted.mistake).at(planted.scene);
        EXPECT_NE(said.find(planted.says), std::string::npos) << planted.mistake << ": " << said;
    }
}

TEST(ClientCheck, ACommandThatFailsIsALine) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "external.toml",
              "[[renderer]]\nid = \"a\"\ncommand = [\"/bin/sh\", \"-c\", \"echo no device >&2; exit 3 # {scene} {out}\"]\n");
    std::vector<std::string> said;
    EXPECT_EQ(
        checkRenderers(folder.path() / "external.toml", [&](const CheckResult& result) { said.push_back(result.wrong); }),
        ExitCode::AccuracyRegression);
    ASSERT_EQ(said.size(), 6U);
    EXPECT_EQ(said.front(), "its command ended with exit code 3; it last said: no device");
}

} // namespace
} // namespace shadowbench::gate
