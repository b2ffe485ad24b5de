// A small fixed selection of what tools/faults tries: failing calls, kills, the order of writes, work at the same time.
#include "tests/support/program.h"
#include "tools/faults/kills.h"
#include "tools/faults/together.h"
#include "tools/faults/write_order.h"

#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::faults {
namespace {

/// Whether the caller has the time.
bool wanted() { return std::getenv("SHADOWBENCH_FAULTS") != nullptr; }

class Faults : public testing::Test {
protected:
    static void SetUpTestSuite() {
        if (wanted() && canSupervise()) sandbox_ = std::make_unique<Sandbox>(PROGRAM, verbsNamed({"run", "merge", "score"}));
    }
    static void TearDownTestSuite() { sandbox_.reset(); }
    void SetUp() override {
        if (!wanted()) GTEST_SKIP() << "set SHADOWBENCH_FAULTS=1: on a busy machine this takes minutes";
        if (!sandbox_) GTEST_SKIP() << "this system lets no program be supervised (seccomp)";
    }

    static Verb verb(const std::string& name) { return verbsNamed({name}).front(); }

    /// The middle one of the verb's calls of that kind.
    static Trial failed(const std::string& verbName, Kind kind) {
        const std::uint64_t count = countCalls(*sandbox_, verb(verbName))[kind];
        EXPECT_GT(count, 0U) << verbName << " " << name(kind);
        return failCall(*sandbox_, verb(verbName), kind, 1 + count / 2, count, false);
    }
    static void expectHarmless(const Trial& trial) {
        EXPECT_TRUE(trial.faults.empty()) << trial.verb << ", " << trial.call << " " << trial.number << ", " << trial.what
                                          << ": " << fmt::format("{}", fmt::join(trial.faults, "\n"));
    }

    static std::unique_ptr<Sandbox> sandbox_;
};

std::unique_ptr<Sandbox> Faults::sandbox_;

TEST_F(Faults, AFailingCallIsALineAndTheNextRunGoesOn) {
    const Trial rename = failed("run", Kind::Rename);
    expectHarmless(rename);
    EXPECT_EQ(rename.code, 1);
    EXPECT_NE(rename.said.find("cannot write"), std::string::npos) << rename.said;
    expectHarmless(failed("run", Kind::Fork));
    expectHarmless(failed("merge", Kind::Write));
    expectHarmless(failed("score", Kind::Fsync));
}

TEST_F(Faults, AFailingAllocationIsALineAndTheNextRunGoesOn) {
    for (const std::uint64_t number : {64U, 4096U}) {
        const auto trial = failAllocation(*sandbox_, verb("merge"), number);
        ASSERT_TRUE(trial) << number;
        expectHarmless(*trial);
    }
}

TEST_F(Faults, AKillLeavesWholeFilesAndEveryRecord) {
    const std::uint64_t moments = countMoments(*sandbox_, verb("run"));
    expectHarmless(killAt(*sandbox_, verb("run"), {SIGKILL, false, moments / 4}, moments));
    expectHarmless(killAt(*sandbox_, verb("run"), {SIGTERM, true, moments / 3}, moments));
    expectHarmless(killAt(*sandbox_, verb("score"), {SIGTERM, false, countMoments(*sandbox_, verb("score")) / 2}, moments));
}

TEST_F(Faults, FilesAreFlushedBeforeTheyAreRenamedAndFoldersAfter) {
    const WriteOrder order = writeOrderOf(*sandbox_, verb("run"));
    EXPECT_TRUE(order.faults.empty()) << fmt::format("{}", fmt::join(order.faults, "\n"));
    EXPECT_GT(order.renames, 2);
}

TEST(FaultsAtOnce, OnOneCacheAndOneOutputNothingIsLostAndNothingDoneTwice) {
    if (!wanted()) GTEST_SKIP() << "set SHADOWBENCH_FAULTS=1: on a busy machine this takes minutes";
    const Together together = workTogether(PROGRAM, 3, [](const std::string&) {});
    EXPECT_TRUE(together.faults.empty()) << fmt::format("{}", fmt::join(together.faults, "\n"));
    EXPECT_FALSE(together.facts.empty());
}

} // namespace
} // namespace shadowbench::faults
