// What a program that is run to its end may do, and that nothing of it is left.
#include "base/process.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"

#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// What SIGTERM does once nobody holds it back any more: nothing.
class HarmlessTermination {
public:
    HarmlessTermination() : before_(std::signal(SIGTERM, [](int) {})) {}
    ~HarmlessTermination() { std::signal(SIGTERM, before_); }
    HarmlessTermination(const HarmlessTermination&) = delete;
    HarmlessTermination& operator=(const HarmlessTermination&) = delete;

private:
    void (*before_)(int);
};

class RunningAProgram : public ::testing::Test {
protected:
    [[nodiscard]] Command script(const std::string& text) const {
        Command command{*findProgram("sh"), {"-c", text}, folder_.path()};
        command.limit = 20s;
        return command;
    }
    Finished run(const Command& command) {
        said_.clear();
        return runProcess(command, [this](std::string_view line) { said_ = line; });
    }
    /// Whether it ends: one that was killed may not know it yet.
    [[nodiscard]] bool endsSoon(const std::string& file) const {
        for (int i = 0; i < 500 && isAlive(file); ++i) usleep(10'000);
        return !isAlive(file);
    }
    /// Whether the process whose id the script left in a file is running.
    [[nodiscard]] bool isAlive(const std::string& file) const {
        const std::string id = readFile(folder_.path() / file);
        std::error_code ignored;
        return !fs::read_symlink(fs::path("/proc") / id.substr(0, id.find('\n')) / "exe", ignored).empty();
    }

    HarmlessTermination harmless_;
    TemporaryFolder folder_; // holds interrupts back
    std::string said_;       // its last line
};

TEST_F(RunningAProgram, TellsAProgramOfOursHowManyThreadsItMayRun) {
    Command command = script("echo ${SHADOWBENCH_THREADS:-all}");
    run(command);
    EXPECT_EQ(said_, "all");
    command.threads = 3;
    run(command);
    EXPECT_EQ(said_, "3");
}

TEST_F(RunningAProgram, TellsHowItEnded) {
    EXPECT_EQ(run(script("exit 3")).exitCode, 3);
    EXPECT_EQ(run(script("kill -SEGV $$")).signal, SIGSEGV);
    EXPECT_EQ(run(script("echo first; echo last >&2")).exitCode, 0);
    EXPECT_EQ(said_, "last");
}

TEST_F(RunningAProgram, EndsItsGrandchildrenWhenItIsLate) {
    Command command = script("sleep 300 & echo $! > grandchild; wait");
    command.limit = 2s;
    EXPECT_TRUE(run(command).timedOut);
    EXPECT_TRUE(endsSoon("grandchild"));
}

TEST_F(RunningAProgram, EndsWhatLeftItsGroupToo) {
    const std::string daemon = "setsid sh -c 'echo $$ > stray; exec sleep 300' & while [ ! -s stray ]; do :; done";
    run(script(daemon));
    ASSERT_TRUE(isAlive("stray")) << "otherwise this test shows nothing";
    kill(std::stoi(readFile(folder_.path() / "stray")), SIGKILL);
    fs::remove(folder_.path() / "stray");
    Command command = script(daemon);
    command.endsStrays = true;
    EXPECT_EQ(run(command).exitCode, 0);
    EXPECT_FALSE(isAlive("stray"));
}

TEST_F(RunningAProgram, EndsOneThatNobodyWantsAnyMore) {
    Command command = script("sleep 300 & echo $! > grandchild; echo begun; wait");
    command.stops = [&] { return said_ == "begun"; };
    const Finished finished = run(command);
    EXPECT_TRUE(finished.stopped);
    EXPECT_FALSE(finished.timedOut);
    EXPECT_TRUE(endsSoon("grandchild"));
}

TEST_F(RunningAProgram, EndsOneThatFloodsItsOutput) {
    Command command = script("yes");
    command.outputLimit = 1 << 20;
    const Finished finished = run(command);
    EXPECT_TRUE(finished.flooded);
    EXPECT_FALSE(finished.timedOut);
}

TEST_F(RunningAProgram, GivesItTheEnvironmentThatIsAsked) {
    run(script("echo $HOME"));
    EXPECT_EQ(said_, folder_.path().string());
    Command command = script("echo $HOME $SKY");
    command.environment = {"HOME=/elsewhere", "SKY=blue"};
    run(command);
    EXPECT_EQ(said_, "/elsewhere blue");
    command.environment = ownEnvironment();
    command.arguments.back() = "echo $PATH";
    run(command);
    EXPECT_EQ(said_, std::getenv("PATH"));
}

TEST_F(RunningAProgram, LiftsTheLimitsThatItIsAskedToLift) {
    run(script("ulimit -v; ulimit -n"));
    EXPECT_EQ(said_, "64");
    Command command = script("ulimit -n; ulimit -v");
    command.memoryLimit.reset();
    command.openFiles.reset();
    run(command);
    rlimit own = {};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &own), 0);
    EXPECT_EQ(said_, own.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(own.rlim_cur / 1024));
}

TEST_F(RunningAProgram, StopsItWhenTheUserInterrupts) {
    EXPECT_THROW(run(script("kill -TERM $PPID; sleep 300")), Inconclusive);
}

TEST_F(RunningAProgram, LetsItLeaveNothingHalfDoneWhenTheUserInterrupts) {
    Command tidy =
        script("trap 'echo all > whole; exit' TERM; echo half > whole; kill -TERM $PPID; while :; do sleep 0.1; done");
    tidy.grace = 10s;
    EXPECT_THROW(run(tidy), Inconclusive);
    EXPECT_EQ(readFile(folder_.path() / "whole"), "all\n");
}

TEST_F(RunningAProgram, StopsItInTheEndWhenTheUserInterrupts) {
    Command stubborn = script("trap '' TERM; echo $$ > stubborn; kill -TERM $PPID; while :; do sleep 0.1; done");
    stubborn.grace = 100ms;
    EXPECT_THROW(run(stubborn), Inconclusive);
    EXPECT_TRUE(endsSoon("stubborn"));
}

} // namespace
} // namespace shadowbench
