// Bad input: one clear line, the documented exit code, no partial file, no crash.
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

struct BadCase {
    std::string name;
    std::string options; // of run; {scene} is the file below
    std::string scene;   // its text
    int code;
    std::string says; // part of the one line
};

/// How a failing case is printed.
void PrintTo(const BadCase& bad, std::ostream* out) { *out << bad.name; }

std::string withLine(const std::string& from, const std::string& to) {
    std::string text = tinyScene();
    text.replace(text.find(from), from.size(), to);
    return text;
}

std::vector<BadCase> badCases() {
    const std::string area = "{ kind = \"rectangle\", centre = [0.2, 6, 0.3], u = [1, 0, 0], v = [0, 0, 1] }";
    return {
        {"MissingScene", "--scene /nowhere/at-all.toml", "", 2, "at-all.toml"},
        {"MisspeltScene", "--scene dueling-frustra", "", 2, "dueling-frusta"},
        {"FolderAsScene", "--scene /tmp", "", 2, "/tmp"},
        {"EmptyScene", "--scene {scene}", "", 2, "bad.toml"},
        {"NotToml", "--scene {scene}", "title = \n", 2, "bad.toml:1"},
        {"UnknownKey", "--scene {scene}", withLine("title", "titel"), 2, "bad.toml:2: titel"},
        {"WrongType", "--scene {scene}", withLine("size = [48, 48]", "size = \"big\""), 2, "bad.toml:3: size"},
        {"NotANumber", "--scene {scene}", withLine("fovy = 45", "fovy = nan"), 2, "camera.fovy"},
        {"OutOfRange", "--scene {scene}", withLine("fovy = 45", "fovy = 190"), 2, "camera.fovy"},
        {"FlatBox", "--scene {scene}", withLine("size = [1.6, 0.4, 1.2]", "size = [1.6, 0, 1.2]"), 2, "size"},
        {"ZeroSizeLight", "--scene {scene}",
         tinyScene("{ kind = \"rectangle\", centre = [0, 6, 0], u = [0, 0, 0], v = [0, 0, 1] }"), 2, "light"},
        {"LightOnSurface", "--scene {scene}", tinyScene("{ kind = \"point\", centre = [3.1, 0, 2.2] }"), 2, "light"},
        {"CameraInsideObject", "--scene {scene}", withLine("eye = [2.1, 6.2, 7.3]", "eye = [0.2, 1.2, 0.2]"), 2, "camera"},
        {"UnclosedMesh", "--scene {scene}", tinyScene() + "[[object]]\nmesh = { file = \"open.obj\", closed = true }\n", 2,
         "bad.toml:17: object[3].mesh.file: not closed"},
        {"UnreadableMesh", "--scene {scene}", tinyScene() + "[[object]]\nmesh = { file = \"none.obj\" }\n", 2, "none.obj"},
        {"UnknownTechnique", "--scene {scene} --technique sm-unifrom", tinyScene(), 2, "sm-uniform"},
        {"UnknownParameter", "--scene {scene} --technique sm-uniform:size=3", tinyScene(), 2, "no parameter \"size\""},
        {"ParameterOutOfRange", "--scene {scene} --technique sm-uniform:map=1", tinyScene(), 2, "16…8192"},
        {"UnknownProfile", "--scene {scene} --profile fast", tinyScene(), 2, "gate"},
        {"UnknownOption", "--scene {scene} --fast", tinyScene(), 2, "--fast"},
        {"MisspeltOption", "--scene {scene} --techniqe none", tinyScene(), 2,
         "run has no option --techniqe (did you mean \"--technique\"?); shadowbench run --help names all"},
        {"UnwritableOutput", "--scene {scene} --technique none --out /proc/nowhere", tinyScene(), 1, "/proc/nowhere"},
        {"MissingPovRay", "--scene {scene} --technique pcss", tinyScene(area), 5, "povray"},
    };
}

class BadInput : public testing::TestWithParam<BadCase> {};

TEST_P(BadInput, EndsInOneLineAndTheDocumentedCode) {
    const BadCase& bad = GetParam();
    const Folder folder;
    const std::string scene = folder.write("bad.toml", bad.scene);
    folder.write("open.obj", "v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n");
    std::string options = bad.options;
    if (const std::size_t at = options.find("{scene}"); at != std::string::npos) options.replace(at, 7, scene);
    if (options.find("--out") == std::string::npos) options += " --out " + folder / "out";
    // POV-Ray is looked up on PATH: an empty one is a machine without it.
    const std::string path = bad.name == "MissingPovRay" ? "PATH=" + folder / "empty" + " " : "";
    const Outcome outcome = shell(path + "shadowbench run --quiet --cache " + folder / "cache" + " " + options);

    EXPECT_EQ(outcome.code, bad.code) << outcome.output;
    EXPECT_NE(outcome.output.find(bad.says), std::string::npos) << outcome.output;
    if (bad.code == 2) {
        EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
        EXPECT_FALSE(fs::exists(folder / "out")) << "something was written";
    }
}

std::string caseName(const testing::TestParamInfo<BadCase>& tested) { return tested.param.name; }

INSTANTIATE_TEST_SUITE_P(Run, BadInput, testing::ValuesIn(badCases()), caseName);

TEST(BadCommand, AnUnknownVerbNamesTheNearMatch) {
    const Outcome outcome = shell("shadowbench rnu");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.output.find("\"run\""), std::string::npos) << outcome.output;
}

TEST(BadCommand, AnOptionThatAVerbOfTwoWordsLacksIsNamed) {
    const Outcome outcome = shell("shadowbench history add results.jsonl --dirt");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.output.find("shadowbench history add has no option --dirt (did you mean \"--dirty\"?)"),
              std::string::npos)
        << outcome.output;
}

TEST(BadCommand, WhereNoTechniqueAppliesTheReasonIsTheLastLine) {
    const Folder folder;
    const Outcome outcome =
        shell("shadowbench run --quiet --cost none --technique pcss --scene " + folder.write("point.toml", tinyScene()) +
              " --cache " + folder.cache() + " --out " + folder / "out");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.output.find("no technique of this run applies to its scene; pcss on point: needs an area light"),
              std::string::npos)
        << outcome.output;
}

TEST(BadCommand, WrongArgumentsOfReferenceEndInOneLine) {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"", "--scene"},
        {"--scene simple --scene trees", "one scene"},
        {"--scene simple --frame 99", "frames 0 to 63"},
        {"--scene simple --truth area --certify", "leave one of them out"},
        {"--scene simple --truth area --oracle povray", "leave out --oracle"},
        {"--scene simple --truth area --oracle rays", "leave out --oracle"},
        {"--scene linear-light --truth irradiance", "linear-light has no irradiance truth"},
        {"--scene linear-light --truth solid-angle", "which has hard, soft, pixel-area, area"},
        {"--scene colonnade --truth irradiance",
         "has no irradiance truth: its light is of kind point, which has hard, pixel-area"},
        {"--verify --truth fuzzy", "hard, soft, pixel-area, area, irradiance, solid-angle"},
        {"--verify --accept", "excludes"},
        {"--verify --samples 64", "excludes"},
        {"--report /tmp/x --out /tmp/y", "excludes"},
        {"--verify --golden /nowhere", "/nowhere/lock.json"},
        {"--verify --frame 99 --golden " SOURCE_FOLDER "/results/reference", "none of the scenes"},
    };
    for (const auto& [options, says] : wrong) {
        const Outcome outcome = shell("shadowbench reference --quiet " + options);
        EXPECT_EQ(outcome.code, 2) << options;
        EXPECT_NE(outcome.output.find(says), std::string::npos) << outcome.output;
        EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
    }
}

TEST(BadCommand, NoVerbIsUsage) { EXPECT_EQ(shell("shadowbench ").code, 2); }

TEST(BadCommand, ALineThatIsNotARecordIsNamedByFileAndNumber) {
    const Folder folder;
    const Outcome outcome = shell("shadowbench report " + folder.write("results.jsonl", "{}\n"));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.output.find("results.jsonl:1"), std::string::npos) << outcome.output;
}

TEST(FullDisk, ARunOntoAFullDiskEndsInOneLineAndLeavesNoPartialRecord) {
    const Folder folder;
    const std::string scene = folder.write("tiny.toml", tinyScene());
    const std::string disk = folder / "disk";
    fs::create_directory(disk);
    if (shell("mount -t tmpfs -o size=16k tmpfs " + disk).code != 0) GTEST_SKIP() << "mounting a small disk needs root";
    shell("dd if=/dev/zero of=" + disk + "/full bs=1k count=12");
    const Outcome outcome = shell("shadowbench run --quiet --scene " + scene + " --technique 'sm-*' --cache " +
                                  folder.cache() + " --out " + disk);
    const bool partial = fs::exists(disk + "/results.jsonl") && fs::file_size(disk + "/results.jsonl") == 0;
    shell("umount " + disk);
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    EXPECT_FALSE(partial);
    EXPECT_NE(outcome.output.find("No space left"), std::string::npos) << outcome.output;
}

} // namespace
} // namespace shadowbench
