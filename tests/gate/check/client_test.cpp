// `check` of renderers: an exact one holds everywhere, and each mistake that one makes is named.
#include "gate/check/client.h"

#include "base/files.h"
#include "base/temporary_folder.h"
#include "groundtruth/store/cache.h"
#include "tests/support/reference_samples.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace shadowbench::gate {
namespace {

/// A row that makes a mistake, and what its images mean.
struct Row {
    std::string id, mistake, definition;
};

/// The folder of truths that a check watches, meanwhile: none that other programs write to.
class CacheFolder {
public:
    explicit CacheFolder(const std::filesystem::path& folder) { setenv("SHADOWBENCH_CACHE", folder.c_str(), 1); }
    ~CacheFolder() { unsetenv("SHADOWBENCH_CACHE"); }
    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;
};

/// `expected`: entries of the list, before its rows; `argument` is told to all rows.
std::vector<CheckResult> resultsOf(const std::vector<Row>& rows, const std::string& expected = "",
                                   const std::string& argument = "") {
    const TemporaryFolder folder;
    std::string list = expected;
    for (const Row& row : rows)
        list +=
            fmt::format("[[renderer]]\nid = \"{}\"\ndefinition = \"{}\"\ncommand = [\"{}\", \"{{scene}}\", \"{{frames}}\", "
                        "\"{{out}}\", \"{}\", \"{}\", \"{}\"]\n",
                        row.id, row.definition, DRAWING_CLIENT, row.mistake, row.definition, argument);
    writeFile(folder.path() / "external.toml", list);
    std::vector<CheckResult> results;
    checkRenderers(folder.path() / "external.toml", [&](const CheckResult& result) { results.push_back(result); });
    return results;
}

/// What is wrong by row and scene.
std::map<std::string, std::map<std::string, std::string>> wrongIn(const std::vector<CheckResult>& results) {
    std::map<std::string, std::map<std::string, std::string>> wrong;
    for (const CheckResult& result : results) {
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

constexpr Planted hardMistakes[] = {
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

constexpr Planted softMistakes[] = {
    {"srgb", "soft", "sRGB-encoded"},
    {"centre-of-area", "soft", "its images are of the definition \"hard\", not \"area\""},
    {"irradiance", "soft", "its images are of the definition \"irradiance\", not \"area\""},
};

/// An entry of the list.
std::string failure(const std::string& scene, const std::string& renderer, const std::string& says) {
    return fmt::format("[[expect]]\nscene = \"{}\"\nrenderers = [\"{}\"]\nsays = \"{}\"\nreason = \"its bias\"\n", scene,
                       renderer, says);
}

/// Of all rows of the tests below at once: what the mistakes draw on a scene is then computed for all of them together.
const std::vector<CheckResult>& allResults() {
    static const std::vector<CheckResult> results = [] {
        std::vector<Row> rows{{"exact", "exact", "area"}, {"exact-hard", "centre-of-area", "hard"}};
        for (const Planted& planted : hardMistakes) rows.push_back({planted.mistake, planted.mistake, "hard"});
        for (const Planted& planted : softMistakes)
            rows.push_back({std::string(planted.mistake) + "-soft", planted.mistake, "area"});
        for (const char* mistake : {"flips", "grey-noise", "writes-own", "writes-scene"})
            rows.push_back({mistake, mistake, "hard"});
        rows.push_back({"after-writes-scene", "exact", "hard"});
        rows.push_back({"expected-bias", "wrong-bias", "hard"});
        rows.push_back({"expected-exact", "exact", "hard"});
        const TemporaryFolder empty;
        const CacheFolder cache(empty.path());
        return resultsOf(rows, failure("contact", "expected-b*", "lit faces shadow themselves") +
                                   failure("hands", "expected-bias", "upside down") +
                                   failure("contact", "expected-exact", "lit faces"));
    }();
    return results;
}

const std::map<std::string, std::map<std::string, std::string>>& allWrong() {
    static const auto wrong = wrongIn(allResults());
    return wrong;
}

TEST(ClientCheck, AnExactRendererHoldsOnEachScene) {
    for (const char* row : {"exact", "exact-hard"})
        for (const auto& [scene, sentence] : allWrong().at(row)) EXPECT_EQ(sentence, "") << row << " on " << scene;
    EXPECT_EQ(allWrong().at("exact-hard").size(), 6U);
    EXPECT_EQ(allWrong().at("exact").size(), 1U); // whose light alone has an area
}

TEST(ClientCheck, NamesTheMistakesOfHardShadows) {
    for (const Planted& planted : hardMistakes) {
        const std::string& said = allWrong().at(planted.mistake).at(planted.scene);
        EXPECT_NE(said.find(planted.says), std::string::npos) << planted.mistake << " on " << planted.scene << ": " << said;
    }
}

TEST(ClientCheck, NamesTheMistakesOfSoftShadows) {
    for (const Planted& planted : softMistakes) {
        const std::string& said = allWrong().at(std::string(planted.mistake) + "-soft").at(planted.scene);
        EXPECT_NE(said.find(planted.says), std::string::npos) << planted.mistake << ": " << said;
    }
}

TEST(ClientCheck, NamesWhatIsWrittenOutsideOfOut) {
    for (const auto& [scene, sentence] : allWrong().at("writes-scene"))
        EXPECT_EQ(sentence, "it wrote outside its {out}: the exported scene's scene.json") << scene;
    for (const auto& [scene, sentence] : allWrong().at("after-writes-scene"))
        EXPECT_EQ(sentence, "") << "the next row has the scene as it was";
    const auto own = notes(allResults(), "1 file was written in ");
    ASSERT_EQ(own.size(), 1U);
    EXPECT_NE(own.front().find(": kept; "), std::string::npos) << own.front();
}

TEST(ClientCheck, NamesATruthThatIsWrittenTo) {
    const TemporaryFolder folder;
    const CacheFolder watched(folder.path());
    const groundtruth::Cache cache(folder.path());
    cache.store(groundtruth::sample(groundtruth::someKey));
    const std::string entry = cache.entries().front().file;
    const auto wrong = wrongIn(resultsOf({{"writes-truth", "writes-truth", "hard"}}, "", entry));
    EXPECT_EQ(wrong.at("writes-truth").at("hands"), "it wrote outside its {out}: " + entry + ", a truth of shadowbench");
}

TEST(ClientCheck, NotesATruthWithNoise) {
    const std::vector<std::string> random = notes(allResults(), "its errors lie at random");
    const auto isNoted = [&](const std::string& row) {
        return std::ranges::any_of(random, [&](const std::string& note) { return note.starts_with(row + ": "); });
    };
    for (const char* row : {"flips", "grey-noise"}) EXPECT_TRUE(isNoted(row)) << row;
    for (const char* row : {"exact-hard", "wrong-bias", "ambient"}) EXPECT_FALSE(isNoted(row)) << row;
}

TEST(ClientCheck, GivesFiguresOfWhatHolds) {
    for (const CheckResult& result : allResults()) {
        const bool isSoft = result.what.starts_with("exact on ");
        if (!isSoft && !result.what.starts_with("exact-hard on ")) continue;
        const std::string says = isSoft ? "the rms error is 0" : "0 % of the pixels are wrong; ";
        EXPECT_TRUE(result.note.starts_with(says) && result.note.ends_with(" s")) << result.what << ": " << result.note;
    }
}

TEST(ClientCheck, AFailureThatIsExpectedIsKnown) {
    for (const CheckResult& result : allResults()) {
        EXPECT_EQ(result.isExpected, result.what == "expected-bias on contact") << result.what;
        EXPECT_EQ(result.isExpected, result.note == "its bias") << result.note;
    }
    const std::string& other = allWrong().at("expected-bias").at("hands");
    EXPECT_TRUE(other.ends_with("expects another failure: \"upside down\"")) << other;
}

TEST(ClientCheck, WhatHoldsAgainstItsListFails) {
    const std::string& wrong = allWrong().at("expected-exact").at("contact");
    EXPECT_TRUE(wrong.starts_with("it holds, and ")) << wrong;
    EXPECT_TRUE(wrong.ends_with(" expects that it fails: its bias; take the entry away")) << wrong;
}

TEST(ClientCheck, RefusesExpectedFailuresOfNoRow) {
    for (const auto& [scene, renderer] : {std::pair("hand", "exact"), std::pair("hands", "other-*")}) try {
            resultsOf({{"exact", "exact", "hard"}}, failure(scene, renderer, "lit faces"));
            ADD_FAILURE() << scene << renderer;
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find("expect[1]: no renderer"), std::string::npos) << error.what();
        }
}

TEST(ClientCheck, ACommandThatFailsIsALine) {
    const TemporaryFolder folder;
    const CacheFolder cache(folder.path() / "cache");
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
