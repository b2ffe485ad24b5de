// A small fixed selection of what tools/faults tries: failing calls, kills, the order of writes, work at the same time.
#include "tools/faults/trials.h"

#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <memory>

namespace shadowbench::faults {
namespace {

class Faults : public testing::Test {
protected:
    static void SetUpTestSuite() {
        std::signal(SIGINT, SIG_DFL); // a shell lets what it starts in the background ignore it, and so would the verbs
        sandbox_ = std::make_unique<Sandbox>(PROGRAM, verbsNamed({"run", "merge", "score"}));
    }
    static void TearDownTestSuite() { sandbox_.reset(); }

    static Verb verb(const std::string& name) { return verbsNamed({name}).front(); }

    static Trial expectHarmless(Trial trial) {
        EXPECT_TRUE(trial.faults.empty()) << trial.verb << ", " << trial.call << " " << trial.number << ", " << trial.what
                                          << ": " << fmt::format("{}", fmt::join(trial.faults, "\n"));
        return trial;
    }
    /// A call of that kind, from the first (0) to the last (1).
    static Trial failed(const std::string& name, Point point, double where, bool lasting = false) {
        const std::uint64_t count = sandbox_->disturbed(verb(name), {}).counts.at(static_cast<std::size_t>(point));
        EXPECT_GT(count, 0U) << name;
        const auto number = 1 + static_cast<std::uint64_t>(where * static_cast<double>(count - 1));
        return expectHarmless(disturb(*sandbox_, verb(name), {point, number, lasting}, count));
    }

    static std::unique_ptr<Sandbox> sandbox_;
};

std::unique_ptr<Sandbox> Faults::sandbox_;

TEST_F(Faults, AFailingCallIsALineAndTheNextRunGoesOn) {
    const Trial rename = failed("run", Point::Rename, 0.5);
    EXPECT_EQ(rename.code, 1);
    EXPECT_EQ(rename.what.find("rename half/"), 0U) << rename.what;
    EXPECT_NE(rename.said.find("cannot write half/"), std::string::npos) << rename.said;
    EXPECT_EQ(failed("run", Point::Fork, 0).code, 1);
    EXPECT_EQ(failed("merge", Point::Open, 0).code, 2);
    EXPECT_EQ(failed("score", Point::Fsync, 0.5).code, 1);
}

TEST_F(Faults, ADiskThatStaysFullIsALineAndTheNextRunGoesOn) {
    const Trial full = failed("merge", Point::Write, 0.5, true);
    EXPECT_EQ(full.code, 1);
    EXPECT_NE(full.said.find("No space left on device"), std::string::npos) << full.said;
}

TEST_F(Faults, AFailingAllocationIsALineAndTheNextRunGoesOn) {
    const Trial trial = expectHarmless(disturb(*sandbox_, verb("merge"), {Point::Allocation, 4096}, 0));
    EXPECT_TRUE(trial.reached);
    EXPECT_EQ(trial.code, 1);
}

TEST_F(Faults, AKillLeavesWholeFilesAndEveryRecord) {
    const auto killed = [](const std::string& name, int signal, bool toFirst) {
        const std::uint64_t moments = sandbox_->disturbed(verb(name), {}).passed.size();
        return expectHarmless(
            disturb(*sandbox_, verb(name), {.number = 1 + moments / 3, .signal = signal, .toFirst = toFirst}, moments));
    };
    EXPECT_EQ(killed("run", SIGKILL, true).code, 128 + SIGKILL);
    EXPECT_EQ(killed("merge", SIGTERM, false).code, 128 + SIGTERM);
    EXPECT_EQ(killed("score", SIGINT, true).code, 128 + SIGINT);
}

TEST_F(Faults, FilesAreFlushedBeforeTheyAreRenamedAndFoldersAfter) {
    Findings findings;
    checkOrder(*sandbox_, verb("run"), findings);
    EXPECT_EQ(findings.faults, Texts{});
    ASSERT_EQ(findings.lines.size(), 1U);
    EXPECT_FALSE(findings.lines[0].starts_with("| run | 0 ")) << "no file is renamed";
}

TEST(FaultsAtOnce, OnOneCacheAndOneOutputNothingIsLostAndNothingDoneTwice) {
    if (std::getenv("SHADOWBENCH_FAULTS") == nullptr)
        GTEST_SKIP() << "set SHADOWBENCH_FAULTS=1: on a busy machine this takes minutes";
    const Findings findings = workTogether(PROGRAM, 3);
    EXPECT_EQ(findings.faults, Texts{});
    EXPECT_FALSE(findings.lines.empty());
}

} // namespace
} // namespace shadowbench::faults
