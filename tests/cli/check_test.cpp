// `check`: the invariants of a technique folder's rows and its own expectations, as a user asks for them.
#include "techniques/folder/templates.h"
#include "tests/support/program.h"
#include "tests/support/technique_folders.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

class CheckOfFolder : public testing::Test {
protected:
    [[nodiscard]] std::string command() const {
        return "shadowbench check " + mine_.path().string() + " --cache " + out_.cache();
    }
    Outcome check(const std::string& before = "") const { return shell(before + " " + command()); }
    /// One of its lines.
    static std::string lineWith(const Outcome& outcome, const std::string& part) {
        const std::size_t at = outcome.output.find(part);
        if (at == std::string::npos) return "none of: " + outcome.output;
        const std::size_t begin = outcome.output.rfind('\n', at) + 1;
        return outcome.output.substr(begin, outcome.output.find('\n', at) - begin);
    }
    void expect(const std::string& lines) const {
        mine_.write("tiny.toml", tinyScene());
        mine_.write("expect.toml", "[[expect]]\nscene = \"tiny.toml\"\n" + lines);
    }

    WrittenTechnique mine_{replaced(mapToml, "range = [16, 8192]", "range = [16, 2048]")};
    Folder out_;
};

TEST_F(CheckOfFolder, PrintsALineForEachAndPassesWhereAllHold) {
    expect("holds = [{ technique = \"my:mine\", metric = \"mismatch\", below = 0.02, reason = \"a\" }]\n"
           "fails = [{ technique = \"my:mine:map=16\", metric = \"mismatch\", above = 0.02, reason = \"b\" }]\n");
    const Outcome outcome = shell("{ " + command() + " 2>/dev/null; }"); // where it says how far truths are
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(outcome.output, "holds  my:mine under a point light: the same bits twice\n"
                              "holds  my:mine under a point light: the light is behind the camera\n"
                              "holds  my:mine under a point light: the light is behind all\n"
                              "holds  my:mine under a point light: nothing casts a shadow\n"
                              "holds  my:mine under a point light: the camera sees nothing\n"
                              "holds  my:mine under a point light: an image of one pixel\n"
                              "holds  my:mine under a directional light: the same bits twice\n"
                              "holds  my:mine under a directional light: the light is behind the camera\n"
                              "holds  my:mine under a directional light: the light is behind all\n"
                              "holds  my:mine under a directional light: nothing casts a shadow\n"
                              "holds  my:mine under a directional light: the camera sees nothing\n"
                              "holds  my:mine under a directional light: an image of one pixel\n"
                              "holds  my:mine at map = 16\n"
                              "holds  my:mine at map = 2048\n"
                              "holds  my:mine on tiny: mismatch below 0.02\n"
                              "holds  my:mine:map=16 on tiny: mismatch above 0.02\n");
}

TEST_F(CheckOfFolder, AnExpectationThatDoesNotHoldIsToldWithItsFigure) {
    expect("holds = [{ technique = \"my:mine:map=16\", metric = \"mismatch\", below = 0.02, reason = \"a\" }]\n"
           "fails = [{ technique = \"my:mine\", metric = \"mismatch\", above = 0.02, reason = \"one of old\" }]\n");
    const Outcome outcome = check();
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_TRUE(lineWith(outcome, "my:mine:map=16 on tiny").starts_with("FAILS  ")) << outcome.output;
    const std::string stopped = lineWith(outcome, "my:mine on tiny");
    EXPECT_TRUE(stopped.starts_with("FAILS  my:mine on tiny: mismatch above 0.02: my:mine on tiny: mismatch is 0.00"))
        << stopped;
    EXPECT_TRUE(stopped.ends_with("is expected to fail, above 0.02: one of old")) << stopped;
}

TEST_F(CheckOfFolder, WhatNoSceneMayDoIsToldWithItsScene) {
    mine_.write("resolve.frag", replaced(mapShader, ": 1.0", ": 1.0;\n    visibility = 0.5 * visibility / visibility"));
    const Outcome outcome = check();
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_EQ(
        lineWith(outcome, "my:mine under a point light: the same bits twice"),
        "FAILS  my:mine under a point light: the same bits twice: a pixel's visibility is NaN, of a division of 0 by 0 or "
        "the like");
    EXPECT_EQ(
        lineWith(outcome, "my:mine under a point light: nothing casts"),
        "FAILS  my:mine under a point light: nothing casts a shadow: 50.0 % of the light is missing on a floor by itself");
}

TEST_F(CheckOfFolder, ParametersAreTriedAtTheirEndsAndEachChoice) {
    const std::string more = "[parameter.gain]\ndefault = 1\nrange = [1, 2.5]\nmeaning = \"m\"\n"
                             "[parameter.kind]\ndefault = \"good\"\nchoices = [\"good\", \"bad\"]\nmeaning = \"m\"\n";
    mine_.write("technique.toml", replaced(mapToml, "[target", more + "[target"));
    mine_.write("resolve.frag", replaced(mapShader, ": 1.0", ": 1.0;\n    visibility *= GAIN") +
                                    "#ifdef KIND_BAD\n#error there is no bad one\n#endif\n");
    const Outcome outcome = check();
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_EQ(lineWith(outcome, "my:mine at gain = 1"), "holds  my:mine at gain = 1");
    EXPECT_EQ(lineWith(outcome, "my:mine at gain = 2.5"),
              "FAILS  my:mine at gain = 2.5: a pixel has the visibility 2.5, which is not within 0 and 1");
    EXPECT_EQ(lineWith(outcome, "my:mine at kind = good"), "holds  my:mine at kind = good");
    EXPECT_EQ(lineWith(outcome, "my:mine at kind = bad"),
              fmt::format("FAILS  my:mine at kind = bad: {}/resolve.frag:12: preprocessor error: #error there is no bad one",
                          mine_.path().string()));
}

TEST_F(CheckOfFolder, AShaderThatHangsIsALineAndTheOthersGoOn) {
    mine_.write("resolve.frag", replaced(hangingShader, "k < 60000", "k < (MAP == 16 ? 60000 : 1)"));
    const Outcome outcome = check("SHADOWBENCH_MAX_CELL_SECONDS=6");
    EXPECT_EQ(outcome.code, 4) << outcome.output;
    EXPECT_EQ(lineWith(outcome, "at map = 16"),
              "FAILS  my:mine at map = 16: the process that drew it took longer than 6 s in the pass \"resolve\" and was "
              "ended: shorten its shaders' loops, or raise SHADOWBENCH_MAX_CELL_SECONDS");
    EXPECT_EQ(lineWith(outcome, "at map = 2048"), "holds  my:mine at map = 2048");
}

TEST_F(CheckOfFolder, WhatCannotBeReadOrCompiledIsOneLineBeforeAnythingIsDrawn) {
    const auto refused = [&](const std::string& end) {
        const Outcome outcome = check();
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
        EXPECT_TRUE(outcome.output.starts_with("shadowbench: " + mine_.path().string() + "/" + end)) << outcome.output;
    };
    expect("holds = [{ technique = \"my:mine\", metric = \"mismatch\", above = 1, reason = \"a\" }]\n");
    refused("expect.toml:3: expect[1].holds[1].above: unknown key");
    expect("holds = [{ technique = \"my:mine\", metric = \"mismatsch\", below = 1, reason = \"a\" }]\n");
    refused("expect.toml:3: expect[1].holds[1].metric: expected one of");
    expect("holds = [{ technique = \"my:mine\", metric = \"map_step\", below = 1, reason = \"a\" }]\n");
    refused("expect.toml:3: expect[1].holds[1].metric: expected one of"); // no run measures it unasked
    expect("holds = [{ technique = \"my:mine:mop=1\", metric = \"leak\", below = 1, reason = \"a\" }]\n");
    refused("expect.toml: \"my:mine:mop=1\": ");
    mine_.write("expect.toml", "[[expect]]\nscene = \"simpel\"\n");
    refused("expect.toml:2: expect[1].scene: \"simpel\" is neither a scene that is built in nor a file beside this one (did "
            "you mean \"simple\"?)");
    mine_.write("expect.toml", "[[expect]]\nscene = \"../tiny.toml\"\n");
    refused("expect.toml:2: expect[1].scene: ");
    mine_.write("expect.toml", "[[expect]]\nscene = \"simple\"\n");
    refused("expect.toml:1: expect[1]: says neither");
    std::filesystem::remove(mine_.path() / "expect.toml");
    mine_.write("resolve.frag", replaced(mapShader, "receiver.seen ?", "receiver.sen ?"));
    refused("resolve.frag:8: ");
    std::filesystem::remove(mine_.path() / "technique.toml");
    EXPECT_EQ(check().output, "shadowbench: " + mine_.path().string() +
                                  " holds neither a technique.toml, of a technique, nor a client.toml, of renderers\n");
}

/// With the truths of the scenes that other tests have left.
TEST(CheckOfTemplates, AllHold) {
    const std::string cache = (std::filesystem::temp_directory_path() / "shadowbench-test-references").string();
    for (const std::string& like : techniques::folderTemplates()) {
        const Folder folder;
        techniques::writeFromTemplate(like, "mine", folder / "mine");
        const Outcome outcome = shell("shadowbench check " + folder / "mine" + " --cache " + cache);
        EXPECT_EQ(outcome.code, 0) << like << "\n" << outcome.output;
        EXPECT_NE(outcome.output.find("on simple: "), std::string::npos) << like;
    }
}

} // namespace
} // namespace shadowbench
