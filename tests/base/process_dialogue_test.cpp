// Asking a running program line by line, with programs that every machine has.
#include "base/error.h"
#include "base/process.h"
#include "base/temporary_folder.h"

#include <array>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shadowbench {
namespace {

class DialogueWith : public ::testing::Test {
protected:
    [[nodiscard]] Command command(const std::string& program, const std::vector<std::string>& arguments = {}) const {
        Command c{*findProgram(program), arguments, folder_.path()};
        return c;
    }

    TemporaryFolder folder_;
};

TEST_F(DialogueWith, CatAnswersEveryLineWithItself) {
    Dialogue cat(command("cat"));
    EXPECT_EQ(cat.ask("pcss:taps=32+32"), "pcss:taps=32+32");
    EXPECT_EQ(cat.ask(""), "");
    EXPECT_EQ(cat.ask("none"), "none");
}

TEST_F(DialogueWith, AProgramThatHasEndedIsInconclusiveNotASignal) {
    Dialogue ended(command("true"));
    EXPECT_THROW(ended.ask("frame"), Inconclusive);
    EXPECT_THROW(ended.ask("frame"), Inconclusive); // by now it is surely gone: writing to it would raise SIGPIPE
}

TEST_F(DialogueWith, AProgramThatDoesNotAnswerIsLate) {
    Command never = command("sleep", {"300"});
    never.limit = std::chrono::milliseconds(300);
    Dialogue silent(never);
    try {
        silent.ask("frame");
        FAIL() << "it answered";
    } catch (const Inconclusive& error) {
        EXPECT_NE(std::string(error.what()).find("did not answer in time"), std::string::npos) << error.what();
    }
}

TEST_F(DialogueWith, WhatAProgramComplainedOfIsInTheError) {
    Dialogue failing(command("sh", {"-c", "echo first >&2; echo no such scene >&2; exit 2"}));
    try {
        failing.ask("frame");
        FAIL() << "it answered";
    } catch (const Inconclusive& error) {
        EXPECT_NE(std::string(error.what()).find("it said: no such scene"), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find("first"), std::string::npos) << error.what();
    }
}

/// Running, not merely waiting for its parent to take note of its end.
bool alive(pid_t pid) {
    std::string name, state;
    std::ifstream("/proc/" + std::to_string(pid) + "/stat") >> pid >> name >> state;
    return !state.empty() && state != "Z" && state != "X";
}

/// Starts a dialogue with a program that ignores the end of its input, tells its id, and waits to be killed.
[[noreturn]] void holdADialogue(const Command& command, int tell) {
    Dialogue held(command);
    const pid_t id = std::stoi(held.ask("id"));
    if (write(tell, &id, sizeof id) == sizeof id)
        for (;;) pause();
    _exit(1);
}

TEST_F(DialogueWith, NoProgramOutlivesAParentThatIsKilled) {
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    const Command command = this->command("sh", {"-c", "read line; echo $$; exec sleep 100"});
    const pid_t parent = fork();
    if (parent == 0) holdADialogue(command, ends[1]);
    pid_t child = 0;
    ASSERT_EQ(read(ends[0], &child, sizeof child), static_cast<ssize_t>(sizeof child));
    EXPECT_TRUE(alive(child));
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    for (int i = 0; i < 500 && alive(child); ++i) usleep(10'000); // the kernel kills it by itself, a little later
    EXPECT_FALSE(alive(child));
    for (const int end : ends) close(end);
}

TEST_F(DialogueWith, AProgramThatIsNotThereCannotBeStarted) {
    Command missing = command("true");
    missing.program = "/nowhere/true";
    EXPECT_THROW(Dialogue{missing}, Inconclusive);
}

} // namespace
} // namespace shadowbench
