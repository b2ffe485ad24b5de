#include "base/error.h"
#include "base/files.h"

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

class Files : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::recursive_directory_iterator(folder_), fs::recursive_directory_iterator()));
    }

    const fs::path folder_ = fs::temp_directory_path() / ("shadowbench-files-" + std::to_string(::getpid()));
};

TEST_F(Files, AreWrittenAndReadBackWhole) {
    const fs::path file = folder_ / "made/on/the/way/a.txt";
    const std::string bytes("one\0two\n", 8);
    writeFile(file, bytes);
    EXPECT_EQ(readFile(file), bytes);
    writeFile(file, "");
    EXPECT_EQ(readFile(file), "");
}

TEST_F(Files, WrittenThroughALibraryGetAPathOfTheSameFolderAndExtension) {
    const fs::path file = folder_ / "a.exr";
    writeFileWith(file, [&](const fs::path& path) {
        EXPECT_EQ(path.parent_path(), folder_);
        EXPECT_EQ(path.extension(), ".exr");
        EXPECT_NE(path, file);
        std::ofstream(path) << "x";
    });
    EXPECT_EQ(readFile(file), "x");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, KeepTheOldContentAndLeaveNothingWhenWritingFails) {
    const fs::path file = folder_ / "a.txt";
    writeFile(file, "old");
    const auto failing = [](const fs::path& path) {
        std::ofstream(path) << "half of the new";
        throw InternalError("disk full");
    };
    EXPECT_THROW(writeFileWith(file, failing), InternalError);
    EXPECT_EQ(readFile(file), "old");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, CannotBeWrittenBelowAFile) { // permission would not stop root
    writeFile(folder_ / "file", "x");
    try {
        writeFile(folder_ / "file" / "a.txt", "y");
        FAIL() << "written";
    } catch (const InternalError& error) {
        EXPECT_NE(std::string(error.what()).find("a.txt"), std::string::npos) << error.what();
    }
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, DoNotReplaceFoldersOrDevices) {
    EXPECT_THROW(writeFile(folder_, "x"), InternalError);
    EXPECT_TRUE(fs::is_directory(folder_));
    EXPECT_THROW(writeFile("/dev/full", "x"), InternalError);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Files, ThatOthersWriteAndRemoveAtTheSameTimeAreWritten) {
    const fs::path file = folder_ / "shared";
    std::atomic<bool> done = false;
    std::thread remover([&] {
        while (!done) fs::remove(file);
    });
    const auto writeOften = [&] {
        for (int i = 0; i < 150; ++i) writeFile(file, "content"); // throws if it asks twice whether the file is there
    };
    std::vector<std::future<void>> writers;
    for (int i = 0; i < 12; ++i) writers.push_back(std::async(std::launch::async, writeOften));
    for (std::future<void>& writer : writers) EXPECT_NO_THROW(writer.get());
    done = true;
    remover.join();
}

TEST_F(Files, ThatOneCommandMakesAgainAreWholeUnderManyWritersToo) {
    const fs::path file = folder_ / "page.html";
    const auto writeOften = [&](char c) {
        for (int i = 0; i < 100; ++i)
            writeFileUnflushed(file, std::string(20'000 + 1000 * static_cast<std::size_t>(c - 'a'), c));
    };
    std::vector<std::future<void>> writers;
    for (const char c : {'a', 'b', 'c', 'd'}) writers.push_back(std::async(std::launch::async, writeOften, c));
    for (int i = 0; i < 200; ++i) {
        if (!fs::exists(file)) continue;
        const std::string text = readFile(file);
        ASSERT_FALSE(text.empty());
        EXPECT_EQ(text.find_first_not_of(text.front()), std::string::npos) << "torn";
        EXPECT_EQ(text.size(), 20'000 + 1000 * static_cast<std::size_t>(text.front() - 'a'));
    }
    for (std::future<void>& writer : writers) EXPECT_NO_THROW(writer.get());
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, OfAKilledWriterAreRemovedByTheNextProcessThatWritesThere) {
    const fs::path fresh = folder_ / "fresh"; // a process looks once
    const fs::path file = fresh / "results.jsonl";
    const auto inAnotherProcess = [](const std::function<void()>& work) {
        const pid_t process = fork();
        if (process == 0) {
            work();
            _exit(0);
        }
        int status = 0;
        waitpid(process, &status, 0);
        return status;
    };
    const int killed = inAnotherProcess([&] {
        writeFileWith(file, [](const fs::path& path) {
            std::ofstream(path) << "half";
            std::raise(SIGKILL);
        });
    });
    EXPECT_TRUE(WIFSIGNALED(killed));
    ASSERT_EQ(entries(), 2U) << "the folder, and what it was writing";
    const fs::path left = fs::directory_iterator(fresh)->path();
    EXPECT_TRUE(isTemporary(left)) << left;

    writeFileWith(fresh / "a.txt", [&](const fs::path& path) {
        EXPECT_FALSE(fs::exists(left));
        inAnotherProcess([&] { writeFile(fresh / "." / "b.txt", "b"); }); // by another name: it looks, too
        EXPECT_TRUE(fs::exists(path)) << "it is still being written";
        std::ofstream(path) << "a";
    });
    EXPECT_EQ(readFile(fresh / "a.txt"), "a");
    EXPECT_EQ(entries(), 3U);
}

TEST_F(Files, ThatAreInterruptedAreFinishedFirst) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "in a copy of a process with threads ThreadSanitizer delivers signals late";
#endif
    const pid_t process = fork();
    if (process == 0) {
        writeFileWith(folder_ / "a.txt", [](const fs::path& path) {
            std::raise(SIGTERM);
            std::ofstream(path) << "whole";
        });
        _exit(0);
    }
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
    EXPECT_EQ(readFile(folder_ / "a.txt"), "whole");
    EXPECT_EQ(entries(), 1U);
}

TEST(TemporaryFiles, AreKnownByTheirNames) {
    EXPECT_TRUE(isTemporary("a/.results.shadowbench-aB3dE6.jsonl"));
    EXPECT_TRUE(isTemporary(".results.shadowbench-aB3dE6"));
    EXPECT_FALSE(isTemporary("a/results.shadowbench-aB3dE6.jsonl"));
    EXPECT_FALSE(isTemporary("a/.results.aB3dE6.jsonl"));
    EXPECT_FALSE(isTemporary("a/.shadowbench-aB3dE6"));
    EXPECT_FALSE(isTemporary("a/.results.shadowbench-aB3dE6x.jsonl"));
}

TEST_F(Files, ThatCannotBeReadAreNamed) {
    EXPECT_THROW(readFile(folder_ / "none"), BadInput);
    EXPECT_THROW(readFile(folder_), BadInput);
}

} // namespace
} // namespace shadowbench
