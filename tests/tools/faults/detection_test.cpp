// tools/faults detects what it should: in a stand-in for the program that does harm where it is tried.
#include "base/temporary_folder.h"
#include "tools/faults/trials.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace shadowbench::faults {
namespace {

namespace fs = std::filesystem;

class Detection : public testing::Test {
protected:
    /// A verb that writes one file; `harm`: what it does when it is tried, instead.
    [[nodiscard]] Trial tried(const std::string& harm) const {
        Sandbox sandbox = sandboxWith(harm);
        sandbox.patience = std::chrono::milliseconds(0);
        return disturb(sandbox, verb, {}, 0);
    }
    [[nodiscard]] Sandbox sandboxWith(const std::string& harm) const {
        const fs::path program = folder_.path() / "program";
        std::ofstream(program)
            << "#!/bin/sh\nmkdir -p kept out\n"
            << "[ \"$1\" = write ] || { echo {} >kept/results.jsonl; exit 0; }\n[ -n \"$SHADOWBENCH_FAULT_PLAN\" ] && {\n"
            << harm << "\n}\n(echo a; echo b) >out/file\n";
        fs::permissions(program, fs::perms::owner_all);
        return Sandbox(program, {verb});
    }
    static bool has(const Trial& trial, const std::string& words) {
        return std::ranges::any_of(trial.faults, [&](const std::string& f) { return f.find(words) != f.npos; });
    }

    const Verb verb{"write", "write --out out"};
    TemporaryFolder folder_;
};

TEST_F(Detection, OfNoHarmThereIsNoFault) { EXPECT_EQ(tried(":").faults, Texts{}); }

TEST_F(Detection, OfAPartialFile) {
    const Trial trial = tried("echo {\"a\": >out/file.json; echo 'shadowbench: no space'; exit 1");
    EXPECT_TRUE(has(trial, "out/file.json is partial"));
    EXPECT_EQ(trial.said, "shadowbench: no space");
    EXPECT_TRUE(has(trial, "after the next run, out/file.json is partial"));
}

TEST_F(Detection, OfALostRecord) {
    EXPECT_TRUE(has(tried("rm kept/results.jsonl"), "a record of kept/results.jsonl is lost"));
}

TEST_F(Detection, OfWhatIsLeft) {
    EXPECT_TRUE(has(tried("echo >out/.file.shadowbench-abcdef"), "out/.file.shadowbench-abcdef is left"));
    EXPECT_TRUE(has(tried("mkdir tmp/folder"), "tmp/folder is left"));
    EXPECT_TRUE(has(tried("setsid sleep 100 &"), "1 processes are left"));
}

TEST_F(Detection, OfAnEnd) {
    EXPECT_TRUE(has(tried("exit 9"), "it ended with 9"));
    EXPECT_TRUE(has(tried("exit 1"), "it did not say why"));
    EXPECT_TRUE(has(tried("exit 0"), "it ended with 0, but out/file is missing"));
}

TEST_F(Detection, OfAFileThatIsWrittenInPlace) {
    Sandbox sandbox = sandboxWith(":");
    Findings findings;
    checkOrder(sandbox, verb, findings);
    EXPECT_EQ(findings.faults, Texts{"write: out/file is written in place"});
}

TEST(Spread, HasTheFirstAndTheLast) {
    EXPECT_EQ(spread(5, 100), (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(spread(100, 3), (std::vector<std::uint64_t>{1, 50, 100}));
    EXPECT_EQ(spread(7, 1), (std::vector<std::uint64_t>{1}));
    EXPECT_TRUE(spread(0, 3).empty());
}

} // namespace
} // namespace shadowbench::faults
