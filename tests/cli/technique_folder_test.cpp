// A technique folder as a user runs it.
#include "base/files.h"
#include "harness/records/record.h"
#include "tests/support/program.h"
#include "tests/support/technique_folders.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace shadowbench {
namespace {

class TechniqueFolderRun : public testing::Test {
protected:
    TechniqueFolderRun() { out_.write("tiny.toml", tinyScene()); }

    [[nodiscard]] std::string command(const std::string& more) const {
        return "shadowbench run --scene " + out_ / "tiny.toml" + " --technique-folder " + mine_.path().string() +
               " --cache " + out_.cache() + " --out " + out_ / "out" + " --quiet " + more;
    }
    Outcome run(const std::string& more = "") const { return shell(command(more)); }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(out_ / "out/results.jsonl"); }

    WrittenTechnique mine_;
    Folder out_;
};

TEST_F(TechniqueFolderRun, ItsRowsAloneRunAndArePrinted) {
    const Outcome outcome = run("--cost none");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("my:mine"), std::string::npos) << outcome.output;
    ASSERT_EQ(records().size(), 1U);
    EXPECT_EQ(records().front().technique, "my:mine");
    const std::string cell = records().front().cell;
    run("--cost none --resume");
    EXPECT_EQ(records().front().cell, cell);
    mine_.write("resolve.frag", replaced(mapShader, ": 1.0", ": 0.0"));
    run("--cost none --resume");
    EXPECT_NE(records().front().cell, cell);
}

TEST_F(TechniqueFolderRun, ItScoresAndCostsWhatTheRowDoesThatIsBuiltIn) {
    const Outcome outcome = run("--technique my:mine --technique sm-uniform --cost instructions");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    ASSERT_EQ(records().size(), 2U);
    const Record mine = records()[0], builtIn = records()[1];
    EXPECT_EQ(mine.technique, "my:mine");
    EXPECT_EQ(mine.images, builtIn.images); // the same bits
    EXPECT_EQ(mine.values["cost.work.fragments"], builtIn.values["cost.work.fragments"]);
    EXPECT_EQ(mine.values["cost.work.vertices"], builtIn.values["cost.work.vertices"]);
    EXPECT_EQ(mine.values["cost.work.draws"], builtIn.values["cost.work.draws"]);
    EXPECT_EQ(mine.values["cost.work.bytes"], builtIn.values["cost.work.bytes"]);
    // Counted by a process of its own, which reads the folder, too.
    EXPECT_NEAR(mine.values["cost.instructions"].value() / builtIn.values["cost.instructions"].value(), 1, 0.01);
}

TEST_F(TechniqueFolderRun, AWrongShaderIsOneLineThatNamesItsPlace) {
    mine_.write("resolve.frag", replaced(mapShader, "receiver.seen ?", "receiver.sen ?"));
    const Outcome outcome = run("--cost none");
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("error: my:mine on tiny: " + (mine_.path() / "resolve.frag").string() + ":8: "),
              std::string::npos)
        << outcome.output;
}

TEST_F(TechniqueFolderRun, ABrokenFolderIsOneLineAndNothingIsWritten) {
    mine_.write("technique.toml", replaced(mapToml, "title", "titel"));
    for (const std::string& words :
         {command(""),
          "shadowbench sweep --quiet --scene " + out_ / "tiny.toml" + " --technique my:mine --axis map --technique-folder " +
              mine_.path().string() + " --out " + (out_ / "out"),
          "shadowbench list techniques --technique-folder " + mine_.path().string(),
          "shadowbench check " + mine_.path().string()}) {
        const Outcome outcome = shell(words);
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_EQ(outcome.output, "shadowbench: " + (mine_.path() / "technique.toml").string() +
                                      ":2: titel: unknown key (did you mean \"title\"?)\n");
        EXPECT_FALSE(std::filesystem::exists(out_ / "out")) << words;
    }
}

TEST_F(TechniqueFolderRun, WhatNothingUsesIsAWarningAndNoMore) {
    const std::string unused = "[parameter.radius]\ndefault = 1\nrange = [1, 8]\nmeaning = \"texels\"\n";
    mine_.write("technique.toml", replaced(mapToml, "[target.depths]", unused + "[target.depths]"));
    const std::string warning =
        "warning: " + (mine_.path() / "technique.toml").string() + ":10: parameter.radius: no shader reads RADIUS";
    for (const Outcome& outcome : {run("--cost none"), shell("shadowbench check " + mine_.path().string())}) {
        EXPECT_EQ(outcome.code, 0) << outcome.output;
        EXPECT_NE(outcome.output.find(warning), std::string::npos) << outcome.output;
        EXPECT_EQ(outcome.output.find("warning: "), outcome.output.rfind("warning: ")) << outcome.output;
    }
}

TEST_F(TechniqueFolderRun, TheGateJudgesItsRowsAgainstRecordsOfBefore) {
    EXPECT_EQ(run("--cost none").code, 0);
    const auto gate = [&] {
        return shell("shadowbench gate --same-program --cost none --scene " + out_ / "tiny.toml" + " --technique-folder " +
                     mine_.path().string() + " --base " + out_ / "out/results.jsonl" + " --cache " + out_.cache() +
                     " --out " + out_ / "gate");
    };
    const Outcome same = gate();
    EXPECT_EQ(same.code, 0) << same.output;
    EXPECT_NE(same.output.find("1 of 1 expected results compared"), std::string::npos) << same.output;
    mine_.write("resolve.frag", replaced(mapShader, "receiver.seen ?", "receiver.seen && gl_FragCoord.x > 22.0 ?"));
    const Outcome worse = gate(); // what was measured of the files before is no answer
    EXPECT_EQ(worse.code, 4) << worse.output;
    EXPECT_NE(worse.output.find("my:mine on tiny: accuracy.leak"), std::string::npos) << worse.output;
    EXPECT_NE(worse.output.find("; the pass resolve was changed"), std::string::npos) << worse.output;
}

TEST_F(TechniqueFolderRun, AShaderThatHangsIsOneLineAndTheOtherRowsGoOn) {
    mine_.write("resolve.frag", hangingShader);
    const Outcome outcome =
        shell("SHADOWBENCH_MAX_CELL_SECONDS=2 " + command("--technique my:mine --technique none --cost none"));
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    EXPECT_NE(
        outcome.output.find("error: my:mine on tiny: the process that rendered it took longer than 2 s in the pass "
                            "\"resolve\" and was ended: shorten its shaders' loops, or raise SHADOWBENCH_MAX_CELL_SECONDS"),
        std::string::npos)
        << outcome.output;
    ASSERT_EQ(records().size(), 2U);
    EXPECT_EQ(records()[0].status, Status::Error);
    EXPECT_EQ(records()[1].status, Status::Scored);
}

TEST_F(TechniqueFolderRun, AShaderThatHangsIsToldByItsPassWhereLaterOnesFollow) {
    mine_.write("hang.frag", hangingShader);
    mine_.write("technique.toml", replaced(replaced(mapToml, "[[pass]]\nname = \"resolve\"",
                                                    "[[pass]]\nname = \"first\"\ndraw = \"screen\"\nfragment = "
                                                    "\"hang.frag\"\nto = \"hangs\"\n\n[[pass]]\nname = \"resolve\""),
                                           "[[pass]]", "[target.hangs]\nformat = \"R32F\"\nsize = \"image\"\n\n[[pass]]"));
    mine_.write("resolve.frag", replaced(replaced(mapShader, "out float", "uniform sampler2D hangs;\nout float"), ": 1.0",
                                         ": texelFetch(hangs, ivec2(0), 0).r"));
    const Outcome outcome = shell("SHADOWBENCH_MAX_CELL_SECONDS=8 " + command("--cost none"));
    EXPECT_NE(outcome.output.find("took longer than 8 s in the pass \"first\" and was ended"), std::string::npos)
        << outcome.output;
}

TEST_F(TechniqueFolderRun, AShaderThatHangsAtSomeValuesOfASweepIsALineForEachAndTheOthersAreScored) {
    mine_.write("resolve.frag", replaced(replaced(hangingShader, "#define SIN sum", "#if MAP == 512\n#define SIN sum"),
                                         "#define SIN8", "#else\n#define SIN\n#endif\n#define SIN8"));
    const Outcome outcome =
        shell("SHADOWBENCH_MAX_CELL_SECONDS=2 shadowbench sweep --quiet --scene " + out_ / "tiny.toml" +
              " --technique my:mine --technique sm-uniform --axis map --values 256,512 --technique-folder " +
              mine_.path().string() + " --cache " + out_.cache() + " --out " + (out_ / "out"));
    EXPECT_EQ(outcome.code, 1) << outcome.output;
    const std::vector<Record> swept = readRecords(out_ / "out/sweep.jsonl");
    ASSERT_EQ(swept.size(), 4U);
    EXPECT_EQ(swept[0].status, Status::Scored);
    EXPECT_EQ(swept[1].status, Status::Error);
    EXPECT_EQ(swept[1].variant, "my:mine:map=512");
    EXPECT_EQ(swept[1].sweep->value, 512);
    EXPECT_EQ(swept[1].reason,
              "the process that rendered it took longer than 2 s in the pass \"resolve\" and was ended: shorten its "
              "shaders' loops, or raise SHADOWBENCH_MAX_CELL_SECONDS");
    EXPECT_EQ(swept[2].status, Status::Scored);
    EXPECT_EQ(swept[3].status, Status::Scored);
}

/// `first` and 40 more, each of which expands to the one before twice.
std::string doubled(const std::string& first, const std::string& next) {
    std::string text = first;
    for (int i = 1; i <= 40; ++i) text += fmt::format(fmt::runtime(next), i, i - 1);
    return text;
}

TEST_F(TechniqueFolderRun, AShaderThatExpandsWithoutEndIsOneLineAndTakesNoMoreMemoryThanItMay) {
    const std::string main = "out float visibility;\nvoid main() { visibility = ";
    for (const std::string& shader :
         {doubled("#define A0 + sin(1.0)\n", "#define A{0} A{1} A{1}\n") + main + "0.0 A40; }\n",
          doubled("float a0(float x) { return sin(x); }\n", "float a{0}(float x) {{ return a{1}(a{1}(x)); }}\n") + main +
              "a40(gl_FragCoord.x); }\n",
          main + std::string(200'000, '-') + "1.0; }\n"}) {
        mine_.write("resolve.frag", shader);
        const Outcome outcome = shell("shadowbench check " + mine_.path().string());
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_TRUE(outcome.output.starts_with("shadowbench: " + (mine_.path() / "resolve.frag").string() + ":"))
            << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    EXPECT_LT(used.ru_maxrss, 2 << 20); // KiB
}

} // namespace
} // namespace shadowbench
