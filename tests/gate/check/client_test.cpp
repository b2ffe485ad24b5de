// `check` of renderers: an exact one holds everywhere, and each mistake that one makes is named.
#include "gate/check/client.h"

#include "base/files.h"
#include "base/temporary_folder.h"
#include "groundtruth/store/cache.h"
#include "tests/support/reference_samples.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench::gate {
namespace {

/// Of rows, each by the mistake that it makes, and by what its images mean; `argument` is told to all.
std::vector<CheckResult> resultsOf(const std::vector<std::pair<std::string, std::string>>& rows,
                                   const std::string& argument = "", const std::string& expected = "") {
    const TemporaryFolder folder;
    std::string list = expected;
    for (const auto& [mistake, definition] : rows)
        list +=
            fmt::format("[[renderer]]\nid = \"{}\"\ndefinition = \"{}\"\ncommand = [\"{}\", \"{{scene}}\", \"{{frames}}\", "
                        "\"{{out}}\", \"{}\", \"{}\", \"{}\"]\n",
                        mistake, definition, DRAWING_CLIENT, mistake, definition, argument);
    writeFile(folder.path() / "external.toml", list);
    std::vector<CheckResult> results;
    checkRenderers(folder.path() / "external.toml", [&](const CheckResult& result) { results.push_back(result); });
    return results;
}

/// What is wrong by row and scene, of renderers that make these mistakes.
std::map<std::string, std::map<std::string, std::string>>
checked(const std::vector<std::pair<std::string, std::string>>& rows, const std::string& argument = "") {
    std::map<std::string, std::map<std::string, std::string>> wrong;
    for (const CheckResult& result : resultsOf(rows, argument)) {
        if (result.what.empty()) continue;
        const std::size_t on = result.what.find(" on ");
        wrong[result.what.substr(0, on)][result.what.substr(on + 4)] = result.wrong;
    }
    return wrong;
}

/// The notes of which a part is `says`.
std::vector<std::string> notes(const std::vector<CheckResult>& results, const std::string& says) {
    std::vector<std::string> found;
    for (const CheckResult& result : results)
        if (result.what.empty() && result.note.find(says) != std::string::npos) found.push_back(result.note);
    return found;
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
        {"light-at-eye", "hands", "is its light at the eye"},
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

TEST(ClientCheck, NamesWhatIsWrittenOutsideOfOut) {
    const auto wrong = checked({{"writes-scene", "hard"}, {"exact", "hard"}});
    for (const auto& [scene, sentence] : wrong.at("writes-scene"))
        EXPECT_EQ(sentence, "it wrote outside its {out}: the exported scene's scene.json") << scene;
    for (const auto& [scene, sentence] : wrong.at("exact"))
        EXPECT_EQ(sentence, "") << "the next row has the scene as it was";
    const auto own = notes(resultsOf({{"writes-own", "hard"}}), "1 file was written in ");
    ASSERT_EQ(own.size(), 1U);
    EXPECT_NE(own.front().find(": kept; "), std::string::npos) << own.front();
}

TEST(ClientCheck, NamesATruthThatIsWrittenTo) {
    const TemporaryFolder folder;
    setenv("SHADOWBENCH_CACHE", folder.path().c_str(), 1);
    const groundtruth::Cache cache(folder.path());
    cache.store(groundtruth::sample(groundtruth::someKey));
    const std::string entry = cache.entries().front().file;
    const auto wrong = checked({{"writes-truth", "hard"}}, entry);
    unsetenv("SHADOWBENCH_CACHE");
    EXPECT_EQ(wrong.at("writes-truth").at("hands"), "it wrote outside its {out}: " + entry + ", a truth of shadowbench");
}

TEST(ClientCheck, NotesATruthWithNoise) {
    const auto results = resultsOf(
        {{"flips", "hard"}, {"grey-noise", "hard"}, {"exact", "hard"}, {"wrong-bias", "hard"}, {"ambient", "hard"}});
    const auto random = notes(results, "its errors lie at random");
    ASSERT_EQ(random.size(), 2U);
    EXPECT_TRUE(random[0].starts_with("flips: ")) << random[0];
    EXPECT_TRUE(random[1].starts_with("grey-noise: ")) << random[1];
}

TEST(ClientCheck, GivesFiguresOfWhatHolds) {
    for (const CheckResult& result : resultsOf({{"exact", "area"}, {"centre-of-area", "hard"}})) {
        const std::string says = result.what.starts_with("exact") ? "the rms error is 0" : "0 % of the pixels are wrong; ";
        EXPECT_TRUE(result.note.starts_with(says) && result.note.ends_with(" s")) << result.what << ": " << result.note;
    }
}

/// An entry of the list.
std::string failure(const std::string& scene, const std::string& renderer, const std::string& says) {
    return fmt::format("[[expect]]\nscene = \"{}\"\nrenderers = [\"{}\"]\nsays = \"{}\"\nreason = \"its bias\"\n", scene,
                       renderer, says);
}

TEST(ClientCheck, AFailureThatIsExpectedIsKnown) {
    const auto results = resultsOf({{"wrong-bias", "hard"}}, "",
                                   failure("contact", "wrong-*", "lit faces shadow themselves") +
                                       failure("hands", "wrong-bias", "upside down"));
    for (const CheckResult& result : results) {
        EXPECT_EQ(result.isExpected, result.what == "wrong-bias on contact") << result.what;
        EXPECT_EQ(result.isExpected, result.note == "its bias") << result.note;
        if (result.what != "wrong-bias on hands") continue;
        EXPECT_TRUE(result.wrong.ends_with("expects another failure: \"upside down\"")) << result.wrong;
    }
}

TEST(ClientCheck, WhatHoldsAgainstItsListFails) {
    const auto results = resultsOf({{"exact", "hard"}}, "", failure("contact", "exact", "lit faces"));
    for (const CheckResult& result : results) {
        if (result.what != "exact on contact") continue;
        EXPECT_FALSE(result.isExpected);
        EXPECT_TRUE(result.wrong.starts_with("it holds, and ")) << result.wrong;
        EXPECT_TRUE(result.wrong.ends_with(" expects that it fails: its bias; take the entry away")) << result.wrong;
    }
}

TEST(ClientCheck, RefusesExpectedFailuresOfNoRow) {
    for (const auto& [scene, renderer] : {std::pair("hand", "exact"), std::pair("hands", "other-*")}) try {
            resultsOf({{"exact", "hard"}}, "", failure(scene, renderer, "lit faces"));
            ADD_FAILURE() << scene << renderer;
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find("expect[1]: no renderer"), std::string::npos) << error.what();
        }
}

TEST(ClientCheck, ACommandThatFailsIsALine) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "external.toml",
              "[[renderer]]\nid = \"a\"\ncommand = [\"/bin/sh\", \"-c\", \"echo no device >&2; exit 3 # {scene} {out}\"]\n");
    std::vector<CheckResult> said;
    EXPECT_EQ(checkRenderers(folder.path() / "external.toml", [&](const CheckResult& result) { said.push_back(result); }),
              ExitCode::AccuracyRegression);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said.front().what, "a on hands");
    EXPECT_EQ(said.front().wrong, "its command ended with exit code 3; it last said: no device");
    EXPECT_EQ(said.back().note, "a fails in the same way on sun, moving, contact, sheets, soft");
}

} // namespace
} // namespace shadowbench::gate
