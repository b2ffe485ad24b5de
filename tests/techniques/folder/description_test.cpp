// What technique.toml says, and the one line that a wrong one gets.
#include "techniques/folder/inputs.h"
#include "techniques/folder/keys.h"
#include "techniques/folder/pass_program.h"
#include "tests/support/message_of.h"
#include "tests/support/technique_folders.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <regex>
#include <utility>

namespace shadowbench {
namespace {

using techniques::Answer;
using techniques::Domain;
using techniques::IntegerRange;
using techniques::OneOf;
using techniques::RealRange;

TEST(TechniqueFolder, IsAnEntryOfTheCatalogue) {
    const techniques::Entry entry = WrittenTechnique(replaced(mapToml, "title", "source = \"Nobody 2026\"\ntitle")).entry();
    EXPECT_EQ(entry.id, "my:mine");
    EXPECT_EQ(entry.title, "A map");
    EXPECT_EQ(techniques::citation(entry.source), "Nobody 2026");
    EXPECT_EQ(entry.answer, Answer::Hard);
    EXPECT_FALSE(entry.temporal);
    EXPECT_EQ(entry.variants, std::vector<std::string>{""});
    ASSERT_EQ(entry.parameters.size(), 1U);
    EXPECT_EQ(entry.parameters.front().defaultValue, "1024");
    EXPECT_EQ(std::get<IntegerRange>(entry.parameters.front().domain).high, 8192);
}

TEST(TechniqueFolder, NumbersAreWholeWhereNoneHasADecimalPoint) {
    const std::string parameter = "[parameter.radius]\ndefault = 2.5\nrange = [1, 8]\nmeaning = \"m\"\n";
    const std::string choice = "[parameter.kind]\ndefault = \"soft\"\nchoices = [\"hard\", \"soft\"]\nmeaning = \"m\"\n";
    const techniques::Entry entry = WrittenTechnique(replaced(mapToml, "[target", parameter + choice + "[target")).entry();
    ASSERT_EQ(entry.parameters.size(), 3U); // as they are written
    EXPECT_EQ(std::get<RealRange>(entry.parameters[1].domain).low, 1);
    EXPECT_EQ(std::get<OneOf>(entry.parameters[2].domain).values, (std::vector<std::string>{"hard", "soft"}));
}

TEST(TechniqueFolder, HasTheParametersOfADepthMapAfterItsOwn) {
    const auto named = [](const std::string& bias) {
        const std::string map =
            "[parameter.map]\ndefault = 1024\nrange = [16, 8192]\nmeaning = \"texels per side of the map\"\n";
        const std::string toml = replaced(mapToml, map, "[parameter.taps]\ndefault = 2\nrange = [1, 8]\nmeaning = \"m\"\n");
        return WrittenTechnique(replaced(toml, "answer", "depth_map = \"" + bias + "\"\nanswer")).entry().parameters;
    };
    const std::vector<techniques::Parameter> any = named("any-bias"), depth = named("depth-bias");
    ASSERT_EQ(any.size(), 5U);
    EXPECT_EQ(any[0].name, "taps");
    EXPECT_EQ(any[1].name, "map");
    EXPECT_EQ(techniques::describe(any[2].domain), "none|constant|slope|normal-offset");
    EXPECT_EQ(techniques::describe(depth.at(2).domain), "none|constant|slope");
}

TEST(TechniqueFolder, HasTheParametersOfAFolderThatIsBuiltInAfterItsOwn) {
    const std::vector<techniques::Parameter> own =
        WrittenTechnique(replaced(mapToml, "answer", "parameters_of = \"modern/pcss-vogel\"\nanswer")).entry().parameters;
    const std::vector<techniques::Parameter> theirs =
        techniques::readTechniqueFolder(std::filesystem::path(SOURCE_FOLDER) / "techniques/modern/pcss-vogel")
            .entry.parameters;
    ASSERT_EQ(own.size(), 11U); // theirs has four more of its depth map
    EXPECT_EQ(own[0].name, "map");
    for (std::size_t i = 1; i < own.size(); ++i) {
        EXPECT_EQ(own[i].name, theirs[i - 1].name);
        EXPECT_EQ(own[i].defaultValue, theirs[i - 1].defaultValue);
        EXPECT_EQ(techniques::describe(own[i].domain), techniques::describe(theirs[i - 1].domain));
    }
}

TEST(TechniqueFolder, AnyChangeOfAFileIsAnotherDigest) {
    const WrittenTechnique folder;
    const std::string before = folder.entry().digest;
    EXPECT_EQ(folder.entry().digest, before);
    folder.write("notes.txt", "not drawn with");
    EXPECT_EQ(folder.entry().digest, before);
    folder.write("resolve.frag", mapShader + "// a comment\n");
    const std::string after = folder.entry().digest;
    EXPECT_NE(after, before);
    folder.write("technique.toml", mapToml + "# a comment\n");
    EXPECT_NE(folder.entry().digest, after);
}

std::string errorOf(const std::string& toml) {
    const WrittenTechnique folder(toml);
    const std::string error = test::messageOf<BadInput>([&] { folder.entry(); });
    const std::string file = (folder.path() / "technique.toml").string();
    return error.starts_with(file) ? error.substr(file.size()) : error;
}

TEST(TechniqueFolder, WhatIsWrongIsOneLineWithItsPlace) {
    const auto with = [](const std::string& from, const std::string& to) { return errorOf(replaced(mapToml, from, to)); };
    EXPECT_EQ(with("title", "titel"), ":2: titel: unknown key (did you mean \"title\"?)");
    EXPECT_EQ(with("\"mine\"", "\"My row\""), ":1: id: \"My row\" is no id: lower-case letters, digits and -, 40 at most");
    EXPECT_EQ(with("\"hard\"", "\"sharp\""), ":3: answer: expected one of hard, filtered, soft, got \"sharp\"");
    EXPECT_EQ(with("default = 1024", "default = 8"), ":6: parameter.map.default: is not within [16, 8192]");
    EXPECT_EQ(with("to = \"depths\"", "to = \"depth\""),
              ":18: pass[1].to: there is no target \"depth\" (did you mean \"depths\"?)");
    EXPECT_EQ(with("size = \"map\"", "size = \"mat\""),
              ":12: target.depths.size: \"mat\" is no parameter that is a number (did you mean \"map\"?)");
    EXPECT_EQ(with("format = \"Depth32F\"", "format = \"R32F\""),
              ":10: target.depths: only depths compare: format = \"Depth32F\"");
    EXPECT_NE(
        with("\"resolve.frag\"", "\"resolv.frag\"").find("has no shader \"resolv.frag\" (did you mean \"resolve.frag\"?)"),
        std::string::npos);
    EXPECT_NE(errorOf(mapToml + "[[pass]]\nname = \"more\"\ndraw = \"casters\"\nto = \"depths\"\n")
                  .find("the last pass writes the answer: to = \"visibility\""),
              std::string::npos);
    EXPECT_NE(errorOf("id = [").find(":1:"), std::string::npos);
    EXPECT_NE(with("answer", "variants = [\"map=1\"]\nanswer").find("map"), std::string::npos);
    EXPECT_NE(with("compare = true", "history = true").find("say history = true above"), std::string::npos);
    EXPECT_NE(with("draw = \"casters\"\nto = \"depths\"", "draw = \"casters\"\nto = \"visibility\"")
                  .find("casters are drawn into a map"),
              std::string::npos);
    EXPECT_NE(with("size = \"map\"", "size = 9000").find("target.depths.size"), std::string::npos);
    EXPECT_EQ(with("answer", "depth_map = \"any-bias\"\nanswer"),
              ":3: depth_map: shaders would call map MAP, as map; rename one");
    EXPECT_EQ(with("[2, 64]", "\"bias\""),
              ":19: pass[1].offset: is that of the parameters of a depth map: say depth_map = \"depth-bias\" above");
    EXPECT_EQ(with("[2, 64]", "\"slope\""), ":19: pass[1].offset: expected one of bias, bias-of-slope, got \"slope\"");
    EXPECT_EQ(with("answer", "view = \"cascades\"\nanswer"),
              ":3: view: view = \"cascades\" and [cascades] are said together");
    EXPECT_EQ(with("answer", "cascades = { count = 4 }\nanswer"),
              ":3: cascades: view = \"cascades\" and [cascades] are said together");
    const auto pattern = [&](const std::string& keys) {
        return with("answer", "pattern.points = { " + keys + " }\nanswer");
    };
    EXPECT_EQ(pattern("kind = \"grid\", sigma = 2"), ":3: pattern.points.sigma: is of a pattern of the kind gaussian");
    EXPECT_EQ(pattern("kind = \"gaussian\""), ":3: pattern.points.sigma: missing");
    EXPECT_EQ(pattern("kind = \"jitter\", taps = 1, sectors = 1"),
              ":3: pattern.points.taps: expected a whole number from 2 to 1024, got 1");
    EXPECT_EQ(with("offset", "when = \"map=512\"\noffset"),
              ":19: pass[1].when: \"map=512\" is no word of a parameter with choices, as \"depth=midpoint\"");
    EXPECT_EQ(with("offset", "peel = true\noffset"),
              ":19: pass[1].peel: needs a target of depths, behind which it draws, and another with a fragment shader");
    EXPECT_EQ(with("[parameter.map]", "[parameter.tiles]\ndefault = 1\nrange = [1, 2]\nmeaning = \"m\"\n\n[parameter.map]"),
              ":5: parameter.tiles: shaders have a macro TILES already; choose another name");
    const auto cascades = [&](const std::string& keys) {
        return with("answer", "view = \"cascades\"\ncascades = { " + keys + " }\nanswer");
    };
    EXPECT_EQ(cascades("count = 9"), ":4: cascades.count: expected a whole number from 0 to 8, got 9");
    EXPECT_EQ(cascades("count = \"map\""), ":4: cascades.count: map must be a whole number within 0 and 8");
    EXPECT_EQ(cascades("count = 4, blend = 0.7"), ":4: cascades.blend: is not within 0 and 0.5");
    EXPECT_EQ(cascades("count = 4, fit = \"map\""),
              ":4: cascades.fit: map must be a parameter with choices among visible, view");
    EXPECT_EQ(cascades("count = 4, warp = \"lispms\""),
              ":4: cascades.warp: expected one of lispsm, none, got \"lispms\" (did you mean \"lispsm\"?)");
    EXPECT_EQ(cascades("count = 4, latency = 1"),
              ":4: cascades.latency: fits slices to what the frame before showed: say history = true above");
    EXPECT_NE(
        with("answer", "history = true\nview = \"cascades\"\ncascades = { count = 4, latency = 1, fit = \"view\" }\nanswer")
            .find("latency=1 goes with fit=visible"),
        std::string::npos);
    EXPECT_NE(cascades("count = 4, stable = \"texels\"").find("stable=texels goes with fit=view and warp=none"),
              std::string::npos);
    EXPECT_EQ(
        with("answer = \"hard\"", "answer = \"soft\"\nview = \"cascades\"\ncascades = { count = 4, warp = \"lispsm\" }"),
        ":5: cascades.warp: is of maps of a light's centre alone: leave it out of a technique whose answer is soft");
    EXPECT_EQ(with("answer", "parameters_of = \"modern/pcss-vogle\"\nanswer"),
              ":3: parameters_of: there is no folder \"modern/pcss-vogle\" that is built in (did you mean "
              "\"modern/pcss-vogel\" or "
              "\"modern/pcf-vogel\"?)");
    EXPECT_NE(with("[parameter.map]", "[parameter.__map]").find("is no name in GLSL"), std::string::npos);
}

TEST(TechniqueFolder, HoldsItsOwnFilesAlone) {
    const TemporaryFolder empty;
    EXPECT_NE(
        test::messageOf<BadInput>([&] { techniques::readTechniqueFolder(empty.path()); }).find("technique.toml is missing"),
        std::string::npos);
    EXPECT_NE(test::messageOf<BadInput>([&] {
                  techniques::readTechniqueFolder(empty.path() / "none");
              }).find("there is no technique folder"),
              std::string::npos);
    const WrittenTechnique folder;
    std::filesystem::create_symlink("/etc/hostname", folder.path() / "more.glsl");
    EXPECT_NE(test::messageOf<BadInput>([&] { folder.entry(); }).find("is no file of the folder"), std::string::npos);
}

TEST(TechniqueFolder, APassIsAnotherWhereItsShaderWhatThatIncludesOrItsStateIs) {
    const WrittenTechnique folder(mapToml, "#include \"more.glsl\"\n");
    folder.write("more.glsl", "// one\n");
    folder.write("unused.glsl", "// one\n");
    const auto hashes = [&] { return techniques::passHashes(techniques::readTechniqueFolder(folder.path())); };
    const auto before = hashes();
    ASSERT_EQ(before.size(), 2U);
    folder.write("unused.glsl", "// two\n");
    EXPECT_EQ(hashes(), before);
    folder.write("more.glsl", "// two\n");
    EXPECT_NE(hashes().at("resolve"), before.at("resolve"));
    EXPECT_EQ(hashes().at("depth map"), before.at("depth map"));
    folder.write("more.glsl", "// one\n");
    for (const auto& [from, to] :
         {std::pair("offset = [2, 64]", "offset = [2, 65]"), std::pair("size = \"map\"", "size = 64"),
          std::pair("offset", "cull = \"back\"\noffset")}) {
        folder.write("technique.toml", replaced(mapToml, from, to));
        EXPECT_NE(hashes().at("depth map"), before.at("depth map")) << to;
        EXPECT_EQ(hashes().at("resolve"), before.at("resolve")) << to;
    }
}

TEST(TechniqueFolder, TheDocumentNamesEveryInputOfShaders) {
    const std::string page = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/technique-folders.md");
    for (const techniques::FolderInput& input : techniques::folderInputs())
        EXPECT_NE(page.find(fmt::format("| `{}` | {} | {} |", input.name, input.type, input.meaning)), std::string::npos)
            << input.name;
}

TEST(TechniqueFolder, TheDocumentNamesFunctionsThatOurShadersHave) {
    const std::string page = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/technique-folders.md");
    const std::regex row("\n\\| ([a-z_/]+\\.glsl) \\| (.*) \\|"), call("`([a-zA-Z]+)\\(");
    int functions = 0;
    for (std::sregex_iterator i(page.begin(), page.end(), row), end; i != end; ++i) {
        const std::string shader = gl::loadShader((*i)[1], {}).text, says = (*i)[2];
        for (std::sregex_iterator j(says.begin(), says.end(), call); j != end; ++j, ++functions)
            EXPECT_NE(shader.find((*j)[1].str() + "("), std::string::npos) << (*i)[1] << " " << (*j)[1];
    }
    EXPECT_EQ(functions, 10);
}

TEST(TechniqueFolder, TheDocumentNamesEveryKey) {
    const std::string page = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/technique-folders.md");
    for (const techniques::FolderKey& key : techniques::folderKeys()) {
        const std::string row = fmt::format("| `{}` | {} | {} |", key.name, key.meaning, key.standard);
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
}

TEST(TechniqueFolder, TheSchemaForEditorsIsThatOfTheKeys) {
    const std::string file = readFile(std::filesystem::path(SOURCE_FOLDER) / "docs/technique.schema.json");
    EXPECT_EQ(file, techniques::folderSchema())
        << "write it anew: shadowbench list technique-schema > docs/technique.schema.json";
}

TEST(TechniqueFolder, TheFirstOneOfTheDocumentIsOne) {
    const WrittenTechnique folder(documentedBlocks("toml").at(0));
    folder.write("single_map.frag", documentedBlocks("glsl").at(0));
    EXPECT_EQ(folder.entry().id, "my:first");
}

} // namespace
} // namespace shadowbench
