#include "base/folder_lock.h"

#include "base/error.h"
#include "base/files.h"
#include "base/interrupts.h"
#include "base/temporary_folder.h"

#include <csignal>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

pid_t inAnotherProcess(const std::function<int()>& work) {
    const pid_t process = fork();
    if (process == 0) _exit(work());
    return process;
}

/// The exit code, or 128 + signal.
int endOf(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(FolderLock, LetsOneProcessAtATimeReadAndReplace) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "made/by/it", file = out / "rows";
    constexpr int processes = 6, rows = 20;
    std::vector<pid_t> all;
    for (int i = 0; i < processes; ++i)
        all.push_back(inAnotherProcess([&] {
            for (int row = 0; row < rows; ++row) {
                const FolderLock alone(out);
                writeFileUnflushed(file, (fs::exists(file) ? readFile(file) : "") + "x");
            }
            return 0;
        }));
    for (const pid_t process : all) EXPECT_EQ(endOf(process), 0);
    EXPECT_EQ(readFile(file).size(), static_cast<std::size_t>(processes * rows)) << "rows are lost";
}

TEST(FolderLock, EndsWithItsHolderHoweverThatEnds) {
    const TemporaryFolder folder;
    EXPECT_EQ(endOf(inAnotherProcess([&] {
                  const FolderLock alone(folder.path() / "out");
                  std::raise(SIGKILL);
                  return 0;
              })),
              128 + SIGKILL);
    bool waited = false;
    const FolderLock alone(folder.path() / "out", [&] { waited = true; });
    EXPECT_FALSE(waited);
}

TEST(FolderLock, LeavesNoFolderThatNothingWasPutInto) {
    const TemporaryFolder folder;
    { const FolderLock alone(folder.path() / "a/b"); }
    EXPECT_TRUE(fs::is_empty(folder.path()));
    {
        const FolderLock alone(folder.path() / "a/b");
        writeFile(folder.path() / "a/b/file", "x");
    }
    EXPECT_TRUE(fs::exists(folder.path() / "a/b/file"));
    fs::create_directory(folder.path() / "there");
    { const FolderLock alone(folder.path() / "there"); }
    EXPECT_TRUE(fs::exists(folder.path() / "there")) << "it was there before";
}

TEST(FolderLock, OfAFolderThatCannotBeMadeKeepsNobodyWaiting) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "file", "x");
    EXPECT_NO_THROW(FolderLock(folder.path() / "file"));
    EXPECT_NO_THROW(FolderLock(folder.path() / "file/below"));
}

TEST(FolderLock, IsTakenOverByOneThatWaitedForAFolderThatIsGone) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    const fs::path locked = folder.path() / "locked", waiting = folder.path() / "waiting";
    const pid_t second = inAnotherProcess([&] { // which must not inherit the first's descriptor, and with it the lock
        while (!fs::exists(locked)) usleep(1000);
        const FolderLock alone(out, [&] { writeFile(waiting, ""); });
        writeFile(out / "file", "x");
        return 0;
    });
    auto first = std::make_unique<FolderLock>(out);
    writeFile(locked, "");
    while (!fs::exists(waiting)) usleep(1000);
    first.reset(); // removes the empty folder
    EXPECT_EQ(endOf(second), 0);
    EXPECT_TRUE(fs::exists(out / "file"));
}

TEST(FolderLock, AWaitIsInterruptedWhereInterruptsAreOnlyNoted) {
    const TemporaryFolder folder;
    const FolderLock first(folder.path() / "out");
    const fs::path waiting = folder.path() / "waiting";
    const pid_t second = inAnotherProcess([&] {
        const DeferredInterrupts deferred;
        try {
            const FolderLock alone(folder.path() / "out", [&] { writeFile(waiting, ""); });
        } catch (const Inconclusive&) {
            writeFile(folder.path() / "given up", "");
        }
        return 0; // the folder's own DeferredInterrupts holds the interrupt back until the end
    });
    while (!fs::exists(waiting)) usleep(1000);
    kill(second, SIGTERM);
    EXPECT_EQ(endOf(second), 0);
    EXPECT_TRUE(fs::exists(folder.path() / "given up"));
}

} // namespace
} // namespace shadowbench
