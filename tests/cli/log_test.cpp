// What a run writes where there is no terminal.
#include "base/files.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(Log, ARunWithoutATerminalIsShortAndThePageHasEveryTechnique) {
    const Folder folder;
    const std::string scene = folder.write("tiny.toml", tinyScene());
    const Outcome run = shell("shadowbench run --cost none --technique 'sm-*' --scene " + scene + " --out " +
                              folder / "out" + " --cache " + folder.cache());
    ASSERT_EQ(run.code, 0) << run.output;
    EXPECT_LE(std::ranges::count(run.output, '\n'), 20) << run.output;
    EXPECT_NE(run.output.find("least errors: 5 of "), std::string::npos) << run.output;
    EXPECT_EQ(run.output.find('\r'), std::string::npos) << run.output;

    const std::string page = readFile(folder / "out/report.md");
    for (const char* technique : {"<sub>sm-uniform</sub>", "<sub>sm-psm</sub>", "<sub>sm-alias-free</sub>"})
        EXPECT_NE(page.find(technique), std::string::npos) << technique;
}

/// How often `text` stands in `output`.
int count(const std::string& output, const std::string& text) {
    int times = 0;
    for (std::size_t at = output.find(text); at != std::string::npos; at = output.find(text, at + 1)) ++times;
    return times;
}

TEST(Log, AScenesLeastErrorsStandBeforeTheTruthsOfTheNextAreComputedAndBeforeTimes) {
    const Folder folder;
    const std::string first = folder.write("first.toml", tinyScene());
    const std::string second = folder.write("second.toml", tinyScene("{ kind = \"point\", centre = [1.1, 6.1, -2.3] }"));
    const std::string run = "SHADOWBENCH_CACHE=" + folder / "empty" + " shadowbench run --technique 'pc*' --scene " + first +
                            " --scene " + second + " --out " + folder / "out";
    const Outcome scored = shell(run + " --cost none --trace " + folder / "trace.json");
    ASSERT_EQ(scored.code, 0) << scored.output;
    EXPECT_EQ(count(scored.output, "scene: first"), 1) << scored.output;
    EXPECT_EQ(count(scored.output, "scene: second"), 1) << scored.output;
    EXPECT_LT(scored.output.find("scene: first"), scored.output.find("scene: second"));
    const std::string trace = readFile(folder / "trace.json");
    EXPECT_LT(trace.find("\"name\":\"pcf\""), trace.rfind("truth computed")) << "the first waited for the second's truths";

    const Outcome timed = shell(run);
    ASSERT_EQ(timed.code, 0) << timed.output;
    EXPECT_EQ(count(timed.output, "scene: first"), 2) << timed.output;
    EXPECT_LT(timed.output.find("least errors"), timed.output.find("Pareto front")) << timed.output;
}

} // namespace
} // namespace shadowbench
