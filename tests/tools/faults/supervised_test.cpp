// The supervisor of tools/faults on programs whose calls are known.
#include "tools/faults/supervised.h"

#include "base/files.h"
#include "base/temporary_folder.h"
#include "tools/faults/failing_calls.h"

#include <cerrno>
#include <csignal>
#include <gtest/gtest.h>

namespace shadowbench::faults {
namespace {

class Supervised : public testing::Test {
protected:
    void SetUp() override {
        if (!canSupervise()) GTEST_SKIP() << "this system lets no program be supervised (seccomp)";
    }
    [[nodiscard]] Ended shell(const std::string& line, const Decide& decide) const {
        Job job{.program = std::filesystem::canonical("/bin/sh"),
                .arguments = {"-c", line},
                .folder = folder_.path(),
                .variables = {"PATH=/usr/bin:/bin", "LC_ALL=C"}};
        job.patience = std::chrono::seconds(1);
        return supervise(job, decide);
    }
    static Decision goOn(const Call& /*call*/, pid_t /*root*/) { return {}; }

    TemporaryFolder folder_;
};

TEST_F(Supervised, AProgramRunsAsItWould) {
    const Ended ended = shell("echo out; echo error >&2; exit 3", goOn);
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(ended.output, "out\n");
    EXPECT_EQ(ended.errors, "error\n");
    EXPECT_EQ(ended.strays, 0);
    EXPECT_GT(ended.calls, 0U);
}

TEST_F(Supervised, OneCallFailsAndThoseAroundItDoNot) {
    int opened = 0;
    const Ended ended = shell("echo 1 >a; echo 2 >b; echo 3 >c; true", [&](const Call& call, pid_t) {
        const bool second =
            call.kind == Kind::Open && call.creates && call.path.starts_with(folder_.path().string()) && ++opened == 2;
        return Decision{.error = second ? EMFILE : 0};
    });
    EXPECT_NE(ended.errors.find("cannot create b: Too many open files"), std::string::npos) << ended.errors;
    EXPECT_EQ(readFile(folder_.path() / "a"), "1\n");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b"));
    EXPECT_EQ(readFile(folder_.path() / "c"), "3\n");
}

TEST_F(Supervised, ASignalComesBeforeTheCallIsMade) {
    const Ended ended = shell("echo 1 >a; echo 2 >b; true", [&](const Call& call, pid_t root) {
        const bool b = call.kind == Kind::Open && call.path.ends_with("/b");
        return Decision{.signal = b ? SIGKILL : 0, .whom = root};
    });
    EXPECT_EQ(ended.code, 128 + SIGKILL);
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "a"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b"));
}

TEST_F(Supervised, CallsOfToolsAreToldFromTheProgramsOwn) {
    bool byTool = false, bySelf = false;
    (void)shell("echo 1 >a; cp a b; mv b c; true", [&](const Call& call, pid_t) {
        if (call.path.ends_with("/a") && call.creates) bySelf = call.byProgram;
        if (call.kind == Kind::Rename && call.path.ends_with("/c")) byTool = !call.byProgram && call.from.ends_with("/b");
        return Decision{};
    });
    EXPECT_TRUE(bySelf);
    EXPECT_TRUE(byTool);
}

TEST_F(Supervised, AProcessThatIsLeftIsCountedAndKilled) {
    const Ended ended = shell("setsid sleep 100 & exit 0", goOn);
    EXPECT_EQ(ended.code, 0);
    EXPECT_EQ(ended.strays, 1);
}

TEST(Spread, HasTheFirstAndTheLast) {
    EXPECT_EQ(spread(5, 100), (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(spread(100, 3), (std::vector<std::uint64_t>{1, 50, 100}));
    EXPECT_EQ(spread(7, 1), (std::vector<std::uint64_t>{1}));
    EXPECT_TRUE(spread(0, 3).empty());
}

} // namespace
} // namespace shadowbench::faults
