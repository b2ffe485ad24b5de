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

} // namespace
} // namespace shadowbench
