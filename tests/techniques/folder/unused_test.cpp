// What a technique folder declares and nothing uses.
#include "techniques/folder/templates.h"
#include "techniques/folder/unused.h"
#include "tests/support/built_in_folders.h"
#include "tests/support/technique_folders.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

using Lines = std::vector<std::string>;

/// Without the folder.
Lines unusedIn(const WrittenTechnique& folder) {
    Lines lines = techniques::unusedIn(techniques::readTechniqueFolder(folder.path()));
    for (std::string& line : lines) line = replaced(line, folder.path().string() + "/", "");
    return lines;
}

const std::string radius = "[parameter.radius]\ndefault = 1\nrange = [1, 8]\nmeaning = \"texels\"\n",
                  kind = "[parameter.kind]\ndefault = \"a\"\nchoices = [\"a\", \"b\"]\nmeaning = \"m\"\n",
                  colour = "[target.colour]\nformat = \"R32F\"\nsize = \"map\"\n";

std::string with(const std::string& tables) { return replaced(mapToml, "[target.depths]", tables + "[target.depths]"); }

TEST(UnusedInFolder, AParameterThatNothingReadsIsToldWithItsLine) {
    EXPECT_EQ(unusedIn(WrittenTechnique()), Lines{});
    const std::string shader = mapShader + "// RADIUS\n/* KIND_A\nRADIUS */ float RADIUSES, radius;\n";
    EXPECT_EQ(
        unusedIn(WrittenTechnique(with(radius + kind), shader)),
        (Lines{"technique.toml:10: parameter.radius: no shader reads RADIUS, and no key names it: use it or leave it out",
               "technique.toml:14: parameter.kind: no shader reads KIND_A, KIND_B, and no key names it: use it or leave it "
               "out"}));
}

TEST(UnusedInFolder, AParameterIsReadByAShaderOrAMacroOrAKey) {
    EXPECT_EQ(unusedIn(WrittenTechnique(with(radius), mapShader + "#if 0\nfloat a = RADIUS;\n#endif\n")), Lines{});
    EXPECT_EQ(unusedIn(WrittenTechnique(with(kind), mapShader + "#ifdef KIND_B\n#endif\n")), Lines{});
    const WrittenTechnique includes(with(radius), mapShader + "#include \"more.glsl\"\n");
    includes.write("more.glsl", "const int more = RADIUS;\n");
    EXPECT_EQ(unusedIn(includes), Lines{});
    for (const auto& [from, to] : {std::pair("fragment =", "define = { WIDTH = \"2 * RADIUS\" }\nfragment ="),
                                   std::pair("offset = [2, 64]", "offset = [2, \"radius\"]"),
                                   std::pair("fragment =", "repeat = \"radius\"\nfragment =")})
        EXPECT_EQ(unusedIn(WrittenTechnique(replaced(with(radius), from, to))), Lines{}) << to;
    EXPECT_EQ(unusedIn(WrittenTechnique(replaced(with(kind), "compare = true", "compare = true\nlinear_when = \"kind=b\""))),
              Lines{});
}

TEST(UnusedInFolder, ATargetThatNoPassReadsIsToldWithItsLine) {
    const std::string toml = replaced(replaced(with(colour), "to = \"depths\"", "to = [\"colour\", \"depths\"]"), "offset",
                                      "fragment = \"colour.frag\"\noffset");
    const WrittenTechnique folder(toml);
    folder.write("colour.frag", "out float colour;\nvoid main() { colour = 1.0; }\n");
    EXPECT_EQ(unusedIn(folder), Lines{"technique.toml:10: target.colour: no pass reads it: use it or leave it out"});
    folder.write("resolve.frag",
                 "uniform sampler2D colour;\nout float v;\nvoid main() { v = texture(colour, vec2(0.5)).r; }\n");
    EXPECT_EQ(unusedIn(folder), Lines{}); // depths are what the nearest colour is found by
    folder.write("technique.toml", mapToml);
    EXPECT_EQ(unusedIn(folder), Lines{"technique.toml:10: target.depths: no pass reads it: use it or leave it out"});
}

TEST(UnusedInFolder, OfShadersThatLeadNowhereNothingIsTold) {
    EXPECT_EQ(unusedIn(WrittenTechnique(with(radius), "#include \"nothing.glsl\"\n")), Lines{});
}

TEST(UnusedInFolder, NothingIsUnusedInFoldersThatComeWithTheProgram) {
    std::vector<std::filesystem::path> folders = builtInFolders();
    for (const std::string& like : techniques::folderTemplates())
        folders.push_back(std::filesystem::path(SOURCE_FOLDER) / "techniques/folder/templates" / like);
    for (const std::filesystem::path& folder : folders)
        EXPECT_EQ(techniques::unusedIn(techniques::readTechniqueFolder(folder)), Lines{});
}

} // namespace
} // namespace shadowbench
