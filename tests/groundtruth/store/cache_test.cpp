#include "base/error.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "groundtruth/contract/reference_files.h"
#include "groundtruth/oracle.h"
#include "groundtruth/store/cache.h"
#include "tests/support/failing_call.h"
#include "tests/support/povray_scene.h"
#include "tests/support/reference_samples.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace shadowbench::groundtruth {
namespace {

namespace fs = std::filesystem;

void expectEqual(const Reference& a, const Reference& b) {
    EXPECT_EQ(encode(a), encode(b)); // bit for bit: -0 and 0 differ here
    EXPECT_EQ(a.visibility, b.visibility);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.provenance.tools, b.provenance.tools);
    EXPECT_EQ(a.provenance.seconds, b.provenance.seconds);
}

/// Quick to compute: no POV-Ray.
Request quick() { return {overlappingPlates(), {16, 16}, Truth::Hard}; }

class CacheFolder : public testing::Test {
protected:
    [[nodiscard]] Cache cache() const { return Cache(folder_ / "references"); }

    /// Stores a sample, changes its file's bytes and expects the entry to be refused, reported in one line, and removed.
    void expectRefusedAfter(const std::function<std::string(std::string)>& damage) const {
        cache().store(sample(someKey));
        const fs::path file = cache().entry(someKey, someSources);
        writeFile(file, damage(readFile(file)));
        testing::internal::CaptureStderr();
        EXPECT_FALSE(cache().find(someKey, someSources));
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_NE(said.find("damaged"), said.npos) << said;
        EXPECT_FALSE(fs::exists(file));
    }

    TemporaryFolder owner_;
    fs::path folder_ = owner_.path();
};

TEST_F(CacheFolder, FindsBitForBitWhatWasStored) {
    const Reference stored = sample(someKey);
    cache().store(stored);
    const auto found = cache().find(someKey, someSources);
    ASSERT_TRUE(found);
    expectEqual(*found, stored);
}

TEST_F(CacheFolder, HoldsNothingAtFirstAndSaysNothingAboutIt) {
    testing::internal::CaptureStderr();
    EXPECT_FALSE(cache().find(someKey, someSources));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(CacheFolder, RefusesAnyFlippedByte) {
    const std::size_t size = encode(sample(someKey)).size();
    for (const std::size_t position : {std::size_t{0}, std::size_t{40}, size / 2, size - 9, size - 1})
        expectRefusedAfter([&](std::string bytes) {
            bytes[position] = static_cast<char>(bytes[position] ^ 0x10);
            return bytes;
        });
}

TEST_F(CacheFolder, RefusesATruncatedEntry) {
    const std::size_t size = encode(sample(someKey)).size();
    for (const std::size_t kept : {std::size_t{0}, std::size_t{1}, std::size_t{8}, size / 2, size - 1})
        expectRefusedAfter([&](const std::string& bytes) { return bytes.substr(0, kept); });
}

TEST_F(CacheFolder, RefusesAnEntryOfAnotherKey) {
    expectRefusedAfter([](const std::string&) { return encode(sample(otherKey)); });
}

TEST_F(CacheFolder, RefusesAnAppendedTail) {
    expectRefusedAfter([](const std::string& bytes) { return bytes + "tail"; });
}

TEST_F(CacheFolder, WhatOtherCodeComputedIsNotFound) {
    cache().store(sample(someKey));
    EXPECT_FALSE(cache().find(someKey, otherSources));
    Reference other = sample(someKey, 0.75F);
    other.provenance.sources = otherSources;
    cache().store(other);
    EXPECT_EQ(cache().find(someKey, otherSources)->visibility[0], 0.75F);
    EXPECT_EQ(cache().find(someKey, someSources)->visibility[0], 0.25F);
    EXPECT_EQ(groundtruth::cached(cache(), quick()).provenance.sources, sourcesOf(quick()));
}

TEST_F(CacheFolder, KeysAreHexDigitsAndNothingElse) {
    EXPECT_THROW((void)cache().find(someKey, ""), InternalError);
    EXPECT_THROW((void)cache().find(someKey, "../98765432"), InternalError);
    EXPECT_THROW((void)cache().find("../../etc/passwd", someSources), InternalError);
    EXPECT_THROW((void)cache().find("", someSources), InternalError);
}

TEST_F(CacheFolder, ThreadsThatWriteOneKeyLeaveOneWholeEntry) {
    std::vector<std::thread> writers;
    for (int i = 0; i < 4; ++i)
        writers.emplace_back([&, i] {
            for (int k = 0; k < 25; ++k) cache().store(sample(someKey, 0.25F * static_cast<float>(i)));
        });
    int damaged = 0;
    for (int k = 0; k < 100; ++k) {
        const auto found = cache().find(someKey, someSources);
        damaged += found && found->visibility[0] != found->visibility[1];
    }
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(damaged, 0);
    EXPECT_TRUE(cache().find(someKey, someSources));
    EXPECT_EQ(std::distance(fs::directory_iterator(cache().entry(someKey, someSources).parent_path()), {}),
              1); // no temporary file left
}

TEST_F(CacheFolder, ProcessesThatWriteOneKeyLeaveOneWholeEntry) {
    std::vector<pid_t> children;
    for (int i = 0; i < 2; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            for (int k = 0; k < 25; ++k) cache().store(sample(someKey));
            _exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    const auto found = cache().find(someKey, someSources);
    ASSERT_TRUE(found);
    expectEqual(*found, sample(someKey));
}

TEST_F(CacheFolder, GetComputesOnceAndThenReads) {
    const Reference first = groundtruth::cached(cache(), quick());
    EXPECT_TRUE(fs::exists(cache().entry(first.provenance.key, first.provenance.sources)));
    const Reference second = groundtruth::cached(cache(), quick());
    expectEqual(first, second); // the recorded seconds too: it was not computed again
}

TEST_F(CacheFolder, AKeyThatIsGivenIsNotMadeAgain) {
    const ReferenceKey key{someKey, {{"tool", "1"}}, someSources};
    const Reference reference = groundtruth::cached(cache(), quick(), key);
    EXPECT_EQ(reference.provenance.key, someKey);
    EXPECT_EQ(reference.provenance.tools, key.tools);
    EXPECT_TRUE(cache().find(someKey, someSources));
}

TEST_F(CacheFolder, WhoAsksWhileAReferenceIsBeingComputedWaitsForIt) {
    std::vector<Reference> got(4);
    std::vector<std::thread> asking;
    for (Reference& reference : got) asking.emplace_back([&] { reference = groundtruth::cached(cache(), quick()); });
    for (std::thread& thread : asking) thread.join();
    for (const Reference& reference : got) expectEqual(reference, got.front()); // the recorded seconds too
}

TEST_F(CacheFolder, GetComputesADamagedEntryAgain) {
    const Reference first = groundtruth::cached(cache(), quick());
    writeFile(cache().entry(first.provenance.key, first.provenance.sources), "rubbish");
    testing::internal::CaptureStderr();
    const Reference again = groundtruth::cached(cache(), quick());
    testing::internal::GetCapturedStderr();
    EXPECT_EQ(first.visibility, again.visibility);
    EXPECT_TRUE(cache().find(first.provenance.key, first.provenance.sources));
}

TEST_F(CacheFolder, ACacheThatCannotBeWrittenCostsOneWarning) {
    writeFile(folder_ / "file", "in the way");
    const Cache blocked(folder_ / "file" / "references");
    EXPECT_THROW(blocked.store(sample(someKey)), InternalError);
    testing::internal::CaptureStderr();
    const Reference reference = groundtruth::cached(blocked, quick());
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(reference.visibility.width(), 16);
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_EQ(readFile(folder_ / "file"), "in the way");
}

TEST_F(CacheFolder, AnEntryThatCannotBeReadIsKeptAndCostsAWarning) {
    cache().store(sample(someKey));
    testing::internal::CaptureStderr();
    const auto find = [&] { return std::string(cache().find(someKey, someSources) ? "found" : "not found"); };
    EXPECT_EQ(test::saidWhere(test::failingOpen(EACCES, O_DIRECTORY, 0), find), "not found");
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said, "warning: a stored reference is not used: cannot read " + cache().entry(someKey, someSources).string() +
                        ": Permission denied\n");
    EXPECT_TRUE(cache().find(someKey, someSources));
}

TEST_F(CacheFolder, ADamagedEntryThatCannotBeRemovedIsNotUsedEither) {
    writeFile(cache().entry(someKey, someSources), "rubbish");
    testing::internal::CaptureStderr();
    const auto find = [&] { return std::string(cache().find(someKey, someSources) ? "found" : "not found"); };
    EXPECT_EQ(test::saidWhere({SCMP_SYS(unlink), EROFS}, find), "not found");
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(said.ends_with("; it cannot be removed\n")) << said;
    EXPECT_TRUE(fs::exists(cache().entry(someKey, someSources)));
}

TEST_F(CacheFolder, WrittenReferenceHoldsTheFourChannelsAndTheProvenance) {
    Reference reference = sample(someKey);
    reference.surface(0, 0) = Surface::Receiver;
    writeReference(reference, folder_ / "out");
    const std::string provenance = readFile(folder_ / "out" / "provenance.json");
    for (const char* part : {"povray", "3.7.0.10.unofficial", "1024", someKey.c_str()})
        EXPECT_NE(provenance.find(part), provenance.npos) << part;
    const std::vector<std::pair<std::string, float>> firstPixel{
        {"V", 0.25F}, {"sigma", 1e-41F}, {"mask", 1.0F}, {"edge_distance", std::numeric_limits<float>::infinity()}};
    for (const auto& [channel, value] : firstPixel)
        EXPECT_EQ(readChannel(folder_ / "out" / "visibility.exr", channel)(0, 0), value) << channel;
}

TEST(DefaultCacheFolder, FollowsTheVariablesInOrder) {
    const auto saved = [](const char* name) {
        return std::getenv(name) != nullptr ? std::string(std::getenv(name)) : std::string();
    };
    const std::string own = saved("SHADOWBENCH_CACHE"), xdg = saved("XDG_CACHE_HOME"), home = saved("HOME");
    setenv("SHADOWBENCH_CACHE", "/a", 1);
    setenv("XDG_CACHE_HOME", "/b", 1);
    setenv("HOME", "/c", 1);
    EXPECT_EQ(defaultCacheFolder(), "/a");
    unsetenv("SHADOWBENCH_CACHE");
    EXPECT_EQ(defaultCacheFolder(), "/b/shadowbench");
    setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_EQ(defaultCacheFolder(), "/c/.cache/shadowbench");
    unsetenv("HOME");
    EXPECT_TRUE(defaultCacheFolder().is_absolute()) << "of the user's entry in the system";
    EXPECT_EQ(test::saidByACopy([]() -> std::string {
                  if (::setuid(987'654) != 0) return "there is no home folder: nobody else can be tried";
                  return defaultCacheFolder();
              }).substr(0, 23),
              "there is no home folder");
    own.empty() ? unsetenv("SHADOWBENCH_CACHE") : setenv("SHADOWBENCH_CACHE", own.c_str(), 1);
    xdg.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", xdg.c_str(), 1);
    home.empty() ? unsetenv("HOME") : setenv("HOME", home.c_str(), 1);
}

} // namespace
} // namespace shadowbench::groundtruth
