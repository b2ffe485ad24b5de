// Files and sockets where the system refuses: one sentence, the old content, and nothing left.
#include "base/descriptor.h"
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "tests/support/failing_call.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

using test::failingOpen;
using test::saidByACopy;
using test::saidWhere;

class FailingCalls : public testing::Test {
protected:
    FailingCalls() { writeFile(file_, "old"); }

    /// What writing the file says; it holds what it held where that is anything, and nothing is beside it.
    std::string saidOfWriting(const test::FailingCall& call, const std::string& content = "new") {
        const std::string said = saidWhere(call, [&] {
            writeFile(file_, content);
            return std::string();
        });
        EXPECT_EQ(readFile(file_), said.empty() ? content : "old");
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "only the file itself";
        return said;
    }
    [[nodiscard]] std::string refusal(const std::string& reason) const {
        return "cannot write " + file_.string() + ": " + reason + "; free some space or choose another place";
    }

    const TemporaryFolder folder_;
    const fs::path file_ = folder_.path() / "a.txt";
};

TEST_F(FailingCalls, OfAFullOrBrokenDiskLeaveTheOldFile) {
    EXPECT_EQ(saidOfWriting({SCMP_SYS(write), ENOSPC}), refusal("No space left on device"));
    EXPECT_EQ(saidOfWriting({SCMP_SYS(write), ENOSPC}, std::string(1 << 20, 'x')), refusal("No space left on device"));
    EXPECT_EQ(saidOfWriting({SCMP_SYS(fsync), EIO}), refusal("Input/output error"));
    EXPECT_EQ(saidOfWriting({SCMP_SYS(rename), EROFS}), refusal("Read-only file system"));
    EXPECT_EQ(saidOfWriting(failingOpen(ENOSPC, O_CREAT, O_CREAT)), refusal("No space left on device"));
    EXPECT_EQ(saidOfWriting(failingOpen(EMFILE, O_TRUNC, O_TRUNC)), refusal("Too many open files"));
    const int flags = O_CREAT | O_DIRECTORY | O_NOFOLLOW; // none of them: it is opened once more, to be flushed
    EXPECT_EQ(saidOfWriting(failingOpen(EMFILE, flags, 0)), refusal("Too many open files"));
}

/// Names may not outlive a power cut there, but the file is written.
TEST_F(FailingCalls, OfAFolderThatCannotBeFlushedAreNoFailureToWrite) {
    const int flushed = O_DIRECTORY, mask = O_DIRECTORY | O_NONBLOCK; // who lists a folder opens it with O_NONBLOCK
    for (const int error : {EINVAL, ENOTSUP, EACCES, EPERM})
        EXPECT_EQ(saidOfWriting(failingOpen(error, mask, flushed)), "") << error;
    writeFile(file_, "old");
    const std::string said = saidWhere(failingOpen(EIO, mask, flushed), [&] {
        writeFile(file_, "new");
        return std::string();
    });
    EXPECT_EQ(said, refusal("Input/output error")) << "it is there, but may not last";
}

TEST_F(FailingCalls, OfReadingAreSaid) {
    EXPECT_EQ(saidWhere({SCMP_SYS(read), EIO}, [&] { return readFile(file_); }),
              "cannot read " + file_.string() + ": Input/output error");
    EXPECT_EQ(saidWhere(failingOpen(EACCES, 0, 0), [&] { return readFile(file_); }),
              "cannot read " + file_.string() + ": Permission denied");
}

TEST_F(FailingCalls, OfATemporaryFolderLeaveNone) {
    const std::string said = saidWhere(failingOpen(EMFILE, O_NOFOLLOW | O_DIRECTORY, O_NOFOLLOW | O_DIRECTORY), [&] {
        ::setenv("TMPDIR", folder_.path().c_str(), 1);
        const TemporaryFolder folder;
        return std::string();
    });
    EXPECT_EQ(said, "cannot make a temporary folder in " + folder_.path().string() +
                        ": Too many open files; free some space or set TMPDIR");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1) << "the file that was there";
}

TEST_F(FailingCalls, OfSocketsAreSaid) {
    EXPECT_EQ(saidWhere({SCMP_SYS(socketpair), EMFILE},
                        [&] {
                            makeSockets();
                            return std::string();
                        }),
              "cannot speak to another process: Too many open files");
}

TEST_F(FailingCalls, ANameIsStillTheFilesWhileItIsAndNoLonger) {
    const Descriptor file(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
    EXPECT_TRUE(isStillNamed(file.get(), file_));
    EXPECT_FALSE(isStillNamed(-1, file_)) << "no file";
    writeFile(file_, "another");
    EXPECT_FALSE(isStillNamed(file.get(), file_)) << "replaced";
    fs::remove(file_);
    EXPECT_FALSE(isStillNamed(file.get(), file_)) << "removed";
}

TEST_F(FailingCalls, WorkInThisFolderNeedsNoPath) {
    EXPECT_EQ(saidByACopy([&]() -> std::string {
                  fs::current_path(folder_.path());
                  writeFile("b.txt", "here");
                  std::error_code failed;
                  if (makeFolders("made/on/the/way", failed).size() != 4 || failed) return "not made";
                  return readFile("b.txt");
              }),
              "here");
    EXPECT_TRUE(fs::is_directory(folder_.path() / "made/on/the/way"));
}

TEST_F(FailingCalls, ALinkWithATemporaryFilesNameIsLeftAlone) {
    const fs::path fresh = folder_.path() / "fresh", link = fresh / ".a.shadowbench-aB3dE6.txt";
    fs::create_directories(fresh);
    fs::create_symlink(file_, link);
    writeFile(fresh / "b.txt", "b"); // looks for what killed writers have left
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(readFile(file_), "old");
    EXPECT_FALSE(isTemporary(fresh / ".a.shadowbench-aB3d")) << "too short";
}

TEST_F(FailingCalls, AFileBeyondTheLimitIsNotRead) {
    writeFile(file_, std::string((1 << 20) + 1, 'x'));
    ::setenv("SHADOWBENCH_MAX_TEXT_MIB", "1", 1);
    EXPECT_EQ(saidByACopy([&] { return readFile(file_).substr(0, 1); }),
              "cannot read " + file_.string() +
                  ": it has 1048577 bytes and more, more than the 1 of SHADOWBENCH_MAX_TEXT_MIB, which can be raised");
    ::setenv("SHADOWBENCH_MAX_TEXT_MIB", "99999999", 1);
    EXPECT_EQ(saidByACopy([&] { return readFile(file_); }),
              "SHADOWBENCH_MAX_TEXT_MIB=\"99999999\": expected a whole number from 1 to 1048576");
    ::unsetenv("SHADOWBENCH_MAX_TEXT_MIB");
}

} // namespace
} // namespace shadowbench
