#include "base/last_words.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <new>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace shadowbench {
namespace {

struct End {
    int code = 0; // or 128 + signal
    std::string said;
};

End endOf(const std::function<void()>& work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw InternalError("no pipe");
    const pid_t process = fork();
    if (process == 0) {
        dup2(ends[1], STDERR_FILENO);
        sayWhyAborted();
        work();
        _exit(0);
    }
    close(ends[1]);
    End end;
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = read(ends[0], buffer.data(), buffer.size())) > 0;)
        end.said.append(buffer.data(), static_cast<std::size_t>(count));
    close(ends[0]);
    int status = 0;
    waitpid(process, &status, 0);
    end.code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return end;
}

void expectOneLine(const End& end, const std::string& part) {
    EXPECT_EQ(end.code, static_cast<int>(ExitCode::Internal));
    EXPECT_TRUE(end.said.starts_with("shadowbench: ")) << end.said;
    EXPECT_NE(end.said.find(part), std::string::npos) << end.said;
    EXPECT_EQ(end.said.find('\n'), end.said.size() - 1) << end.said;
}

TEST(LastWords, AnAbortIsOneLineAndTheDocumentedCode) {
    expectOneLine(endOf([] { std::abort(); }), "a library aborted the program");
}

TEST(LastWords, AnExceptionThatLeavesAThreadIsOneLine) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "ThreadSanitizer ends a copy of a process that starts a thread (\"dup thread with used id\")";
#endif
    expectOneLine(endOf([] { std::thread([] { throw std::bad_alloc(); }).join(); }), "not enough memory");
    expectOneLine(endOf([] { std::thread([] { throw std::runtime_error("why"); }).join(); }), "internal error: why");
    const auto noThread = std::make_error_code(std::errc::resource_unavailable_try_again);
    expectOneLine(endOf([&] { std::thread([&] { throw std::system_error(noThread); }).join(); }),
                  "a thread could not be started");
    expectOneLine(endOf([] { std::thread([] { throw 7; }).join(); }), "a library aborted the program");
}

TEST(LastWords, NoFileThatIsBeingWrittenIsLeft) {
    const TemporaryFolder folder;
    const auto aborting = [&] {
        writeFileWith(folder.path() / "a.txt", [](const std::filesystem::path& half) {
            std::ofstream(half) << "half";
            std::abort();
        });
    };
    expectOneLine(endOf(aborting), "a library aborted the program");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(LastWords, AForkedProcessEndsByTheSignalThatItsParentReports) {
    const End end = endOf([] {
        const pid_t process = fork();
        if (process == 0) std::abort();
        int status = 0;
        waitpid(process, &status, 0);
        if (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT) _exit(7);
    });
    EXPECT_EQ(end.code, 7);
    EXPECT_EQ(end.said, "");
}

} // namespace
} // namespace shadowbench
