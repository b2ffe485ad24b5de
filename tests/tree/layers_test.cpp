// Includes point down only: every one of the tree is held to the list of layers that CMake makes the libraries from.
#include "tests/tree/layers.h"

#include "base/files.h"
#include "base/temporary_folder.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace shadowbench::layers {
namespace {

namespace fs = std::filesystem;
using testing::Test;
using Sentences = std::vector<std::string>;

const fs::path root = SOURCE_FOLDER;

TEST(Layers, AreAListThatOnePageHoldsAndThatNamesOnlyLinesAbove) {
    const std::vector<Module> modules = readList(root / "cmake/layers.txt");
    EXPECT_GE(modules.size(), 5U);
    EXPECT_LE(modules.size(), 50U);
    EXPECT_EQ(faultsOfList(modules), Sentences());
    for (const Module& module : modules) EXPECT_TRUE(fs::is_directory(root / module.folder)) << module.folder;
}

TEST(Layers, EveryIncludeOfTheTreeStaysInItsModuleOrLeadsIntoOneThatItsLineNames) {
    const std::vector<Module> modules = readList(root / "cmake/layers.txt");
    const std::vector<Include> includes = includesOf(root, modules);
    EXPECT_GT(includes.size(), 1000U);
    EXPECT_GT(std::ranges::count_if(includes, [](const Include& i) { return isShader(i.file); }), 20);
    const Sentences strays = strayIncludes(modules, includes);
    EXPECT_TRUE(strays.empty()) << fmt::format("{}", fmt::join(strays, "\n"));
}

TEST(Layers, EveryArrowOfTheListIsUsed) {
    const std::vector<Module> modules = readList(root / "cmake/layers.txt");
    const Sentences unused = unusedArrows(modules, includesOf(root, modules));
    EXPECT_TRUE(unused.empty()) << fmt::format("{}", fmt::join(unused, "\n"));
}

/// A tree of three layers, in a folder of its own, in which nothing is wrong.
class SmallTree : public Test {
protected:
    SmallTree() {
        write("base/files.h", "#include <xxhash.h>\n#include <string>\n");
        write("techniques/gl/program.h", "#include \"base/files.h\"\n");
        write("techniques/gl/receiver.glsl", "struct Receiver { vec3 position; };\n");
        write("techniques/maps/uniform/uniform.cpp", "#include \"techniques/gl/program.h\"\n"
                                                     "#include \"techniques/maps/uniform/uniform.h\"\n"
                                                     "#include <fmt/format.h>\n"
                                                     "load(\"maps/uniform/uniform.frag\");\n");
        write("techniques/maps/uniform/uniform.frag", "#include \"gl/receiver.glsl\"\n");
        list("# a comment\nbase: | xxhash threads\ntechniques/gl: base | xxhash\n"
             "techniques/maps: techniques/gl | xxhash\n");
    }

    void write(const std::string& file, const std::string& text) const { writeFile(folder_.path() / file, text); }
    void list(const std::string& text) const { write("layers.txt", text); }
    [[nodiscard]] std::vector<Module> modules() const { return readList(folder_.path() / "layers.txt"); }
    [[nodiscard]] Sentences strays() const { return strayIncludes(modules(), includesOf(folder_.path(), modules())); }
    [[nodiscard]] Sentences unused() const { return unusedArrows(modules(), includesOf(folder_.path(), modules())); }

private:
    TemporaryFolder folder_;
};

TEST_F(SmallTree, HasNoFault) {
    ASSERT_EQ(modules().size(), 3U);
    EXPECT_EQ(modules()[0].packages, Sentences({"xxhash", "threads"}));
    EXPECT_EQ(modules()[2].arrows, Sentences({"techniques/gl"}));
    EXPECT_EQ(faultsOfList(modules()), Sentences());
    EXPECT_EQ(strays(), Sentences());
    EXPECT_EQ(unused(), Sentences());
}

TEST_F(SmallTree, AnUpwardIncludeIsFound) {
    write("techniques/gl/texture.cpp", "#include <vector>\n  #  include \"techniques/maps/uniform/uniform.h\"\n");
    EXPECT_EQ(strays(), Sentences({"techniques/gl/texture.cpp:2: techniques/maps/uniform/uniform.h is of techniques/maps, "
                                   "which the line of techniques/gl does not name"}));
}

TEST_F(SmallTree, AnIncludeOfALowerLayerThatTheLineDoesNotNameIsFound) {
    write("techniques/maps/fit.h", "#include \"base/files.h\"\n");
    EXPECT_EQ(strays(),
              Sentences({"techniques/maps/fit.h:1: base/files.h is of base, which the line of techniques/maps does "
                         "not name"}));
}

TEST_F(SmallTree, AnUpwardIncludeOfAShaderIsFoundAndSoIsALoadedOne) {
    write("techniques/gl/screen.vert", "#include \"maps/uniform/light.glsl\"\n");
    write("techniques/gl/screen.cpp", "Program program(\"maps/uniform/uniform.frag\");\n");
    EXPECT_EQ(strays().size(), 2U);
}

TEST_F(SmallTree, AHeaderOfAPackageThatTheLineDoesNotNameIsFound) {
    write("techniques/gl/json.cpp", "#include <nlohmann/json.hpp>\n");
    EXPECT_EQ(strays(), Sentences({"techniques/gl/json.cpp:1: nlohmann/json.hpp is of json, which the line of techniques/gl "
                                   "does not name"}));
    write("techniques/gl/json.cpp", "#include <rapidjson/document.h>\n");
    EXPECT_EQ(strays().size(), 1U);
}

TEST_F(SmallTree, AFileOutsideOfEveryModuleIsFound) {
    write("techniques/gate.cpp", "#include <string>\n");
    write("base/git.cpp", "#include \"tools/git.h\"\n");
    EXPECT_EQ(strays(), Sentences({"base/git.cpp:1: tools/git.h is of no module, which the line of base does not name",
                                   "techniques/gate.cpp:1: string: no line of the list holds this file"}));
}

TEST_F(SmallTree, ALineThatNamesOneBelowItIsFound) {
    list("base: techniques/gl\ntechniques/gl: base\ntechniques/gl: base\n");
    EXPECT_EQ(faultsOfList(modules()), Sentences({"the line of base names techniques/gl, which has no line above it",
                                                  "techniques/gl has two lines"}));
}

TEST_F(SmallTree, AnArrowThatNothingUsesIsFound) {
    list("base: | xxhash json\ntechniques/gl: base | xxhash\ntechniques/maps: techniques/gl base | xxhash\n");
    EXPECT_EQ(unused(), Sentences({"the line of base names json, of which it includes nothing",
                                   "the line of techniques/maps names base, of which it includes nothing"}));
}

} // namespace
} // namespace shadowbench::layers
