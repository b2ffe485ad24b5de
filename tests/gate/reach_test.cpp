// What can decide a result: planted changes in a small tree, and whose keys they change.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "gate/reach.h"
#include "techniques/catalog.h"

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

/// Sources laid out as those of this project, of the techniques sm-one, sm-two and pcf, and a program's reach by them.
class SmallTree : public testing::Test {
protected:
    SmallTree() {
        for (const auto& [file, text] : std::vector<std::pair<const char*, const char*>>{
                 {"CMakeLists.txt", "link a b"},
                 {"cmake/layers.txt",
                  "# layers\nbase: |\nscene: base |\ntechniques: base |\nharness: techniques |\ngate: harness |\ngpu: |\n"},
                 {"cmake/modules.cmake", "options"},
                 {"results/reference/lock.json", "{}"},
                 {"base/random.h", "constexpr int seed = 1;"},
                 {"harness/cost.cpp", "parseVariant(\"sm-one\"); parseVariant(name);"},
                 {"scene/library/trees.toml", "trees"},
                 {"gate/gate.cpp", "int gate;"},
                 {"gpu/model.cpp", "int waves;"},
                 {"techniques/catalog.inc", "TECHNIQUE(smOne)\nTECHNIQUE(smTwo)\nFOLDER(\"filtered/pcf\")\n"},
                 {"techniques/shared/maps/map.h", "template <int N> struct Map {};"},
                 {"techniques/shared/maps/map.cpp", "load(\"shared/maps/map.vert\");"},
                 {"techniques/shared/maps/map.vert", "void main() {}"},
                 {"techniques/shared/maps/test.glsl", "float test();"},
                 {"techniques/shared/maps/mean.glsl", "#include \"shared/maps/test.glsl\""},
                 {"techniques/maps/sm-one/sm-one.cpp", "Entry smOne();"},
                 {"techniques/maps/sm-two/sm-two.cpp", "load(\"maps/sm-two/\" + file + \".frag\");"},
                 {"techniques/maps/sm-two/near.frag", "void main() {}"},
                 {"techniques/filtered/pcf/technique.toml", "fragment = \"filtered/pcf/pcf.frag\""},
                 {"techniques/filtered/pcf/pcf.frag", "#include \"shared/maps/mean.glsl\""},
                 {"techniques/filtered/pcf/pcf.cpp", "#include \"techniques/maps/sm-two/sm-two.h\""}})
            write(file, text);
    }

    void write(const std::string& file, const std::string& text) const { writeFile(folder_.path() / "tree" / file, text); }

    [[nodiscard]] Reach reach(const std::string& compiler = "gcc 12") const {
        const fs::path tree = folder_.path() / "tree", out = folder_.path() / "out";
        fs::create_directories(out);
        const std::string command = "cmake -DVERSION=1 -DROOT=" + tree.string() + " -DOUT=" + out.string() +
                                    " '-DCOMPILER=" + compiler + "' -P " SOURCE_FOLDER "/cmake/version.cmake";
        EXPECT_EQ(std::system(command.c_str()), 0);
        const std::string text = readFile(out / "embedded_reach.h");
        const std::size_t begin = text.find("R\"(") + 3;
        return Reach(text.substr(begin, text.find(")\"") - begin));
    }

    /// Of the three techniques, those whose key on `scene` differs.
    static std::string changed(const Reach& before, const Reach& after, const std::string& scene = "trees") {
        std::string names;
        for (const char* name : {"sm-one", "sm-two", "pcf"}) {
            EXPECT_TRUE(before.key(name, scene) && after.key(name, scene)) << name;
            if (before.key(name, scene) != after.key(name, scene)) names += std::string(names.empty() ? "" : " ") + name;
        }
        return names;
    }

    TemporaryFolder folder_;
};

constexpr const char* all = "sm-one sm-two pcf";

TEST_F(SmallTree, AChangeReachesTheTechniquesThatItsSourceCanDecide) {
    const Reach before = reach();
    struct Planted {
        const char *file, *text, *reached;
    };
    for (const Planted& planted : {
             Planted{"base/random.h", "constexpr int seed = 2;", all},
             {"harness/cost.cpp", "parseVariant(\"sm-one\"); parseVariant(name); // twice", all},
             {"CMakeLists.txt", "link b a", all},
             {"cmake/modules.cmake", "other options", all},
             {"results/reference/lock.json", "{ }", all},
             {"techniques/shared/maps/map.h", "template <int N> struct Map { int n = N; };", all},
             {"techniques/shared/maps/map.cpp", "load(\"shared/maps/map.vert\"); draw();", all},
             {"techniques/shared/maps/map.vert", "void main() { ; }", all},
             {"techniques/maps/sm-one/sm-one.cpp", "Entry smOne(); // asked for by harness", all},
             {"techniques/maps/sm-one/new.glsl", "float added;", all},
             {"harness/new.cpp", "int added;", all},
             {"techniques/contract/new.h", "int added;", all},
             {"techniques/shared/maps/test.glsl", "float test(); // of a shader that a shader includes", "pcf"},
             {"techniques/filtered/pcf/pcf.frag", "#include \"shared/maps/mean.glsl\"\n// own", "pcf"},
             {"techniques/filtered/pcf/technique.toml", "fragment = \"filtered/pcf/other.frag\"", "pcf"},
             {"techniques/maps/sm-two/near.frag", "void main() { ; }", "sm-two pcf"},
             {"techniques/maps/sm-two/sm-two.h", "int added;", "sm-two pcf"},
             {"techniques/catalog.inc", "TECHNIQUE(smOne)\nTECHNIQUE(smTwo)\nTECHNIQUE(pcf)\n", "pcf"},
             {"techniques/catalog.inc", "TECHNIQUE(smOne)\nFOLDER(\"filtered/pcf\")\nTECHNIQUE(smTwo)\n", ""},
             {"techniques/maps/sm-new/sm-new.cpp", "Entry smNew();", ""},
             {"gate/gate.cpp", "int judge;", ""},
             {"scene/library/new.toml", "new", ""},
             {"docs/gate.md", "# The gate", ""},
         }) {
        SCOPED_TRACE(planted.file);
        const fs::path file = folder_.path() / "tree" / planted.file;
        const std::string was = fs::exists(file) ? readFile(file) : "";
        write(planted.file, planted.text);
        EXPECT_EQ(changed(before, reach()), planted.reached);
        was.empty() ? static_cast<void>(fs::remove(file)) : write(planted.file, was);
    }
}

TEST_F(SmallTree, ATechniqueThatHasTheParametersOfAnotherUsesItsFolder) {
    fs::remove(folder_.path() / "tree/techniques/filtered/pcf/pcf.cpp");
    write("techniques/filtered/pcf/technique.toml", "parameters_of = \"maps/sm-two\"");
    const Reach before = reach();
    write("techniques/maps/sm-two/technique.toml", "another default");
    EXPECT_EQ(changed(before, reach()), "sm-two pcf");
}

TEST_F(SmallTree, ASceneIsReachedByItsFileAndAllByTheCompilerAndANewRoom) {
    const Reach before = reach();
    EXPECT_EQ(changed(before, reach("gcc 13")), all);
    write("scene/library/trees.toml", "other trees");
    EXPECT_EQ(changed(before, reach()), all);
    EXPECT_EQ(changed(before, reach(), "simple"), "");
    write("scene/library/trees.toml", "trees");
    write("physics/wind.cpp", "int wind;");
    EXPECT_EQ(changed(before, reach()), "");
    write("cmake/layers.txt", readFile(folder_.path() / "tree/cmake/layers.txt") + "physics: |\n");
    EXPECT_EQ(changed(before, reach()), all);
}

TEST_F(SmallTree, AModelOfGraphicsProcessorsDecidesFiguresOfShadersAndNoCell) {
    const Reach before = reach();
    write("gpu/model.cpp", "int lanes;");
    EXPECT_EQ(changed(before, reach()), "");
    EXPECT_NE(before.hash(Reach::shaderFigures), reach().hash(Reach::shaderFigures));
    write("gpu/model.cpp", "int waves;");
    write("base/random.h", "constexpr int seed = 2;");
    EXPECT_EQ(before.hash(Reach::shaderFigures), reach().hash(Reach::shaderFigures)) << "a key of a cell has the rest";
    EXPECT_FALSE(before.hash("nothing-of-this-name"));
}

TEST(OwnReach, NamesWhatDecidesEveryBuiltInTechnique) {
    const Reach own = Reach::own();
    for (const techniques::Entry& entry : techniques::catalog()) EXPECT_TRUE(own.key(entry.id, "trees")) << entry.id;
    EXPECT_FALSE(own.key("nothing-of-this-name", "trees"));
    EXPECT_FALSE(Reach().key("pcf", "trees"));
    EXPECT_TRUE(own.units("pcf-blur", "trees").contains("shared/filters/pcf.glsl")) << "by the folder of pcf";
    EXPECT_FALSE(own.units("pcf-blur", "trees").contains("modern/evsm"));
    EXPECT_THROW(Reach("filtered/pcf\n"), BadInput);
}

} // namespace
} // namespace shadowbench::gate
