// The cache's size, age and health.
#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/temporary_folder.h"
#include "groundtruth/contract/reference_files.h"
#include "groundtruth/store/cache.h"
#include "groundtruth/store/cache_limits.h"
#include "tests/support/reference_samples.h"

#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <sys/wait.h>
#include <unistd.h>

namespace shadowbench::groundtruth {
namespace {

namespace fs = std::filesystem;
using std::chrono::hours;

std::string keyOf(int number) { return fmt::format("{:032x}", 0x1234567890abcdefU * static_cast<std::uint64_t>(number)); }

const std::uintmax_t entryBytes = encode(sample(someKey)).size();

std::vector<std::string> keys(const std::vector<CacheEntry>& entries) {
    std::vector<std::string> result;
    for (const CacheEntry& entry : entries) result.push_back(entry.key);
    return result;
}

std::uintmax_t total(const Cache& cache) {
    std::uintmax_t bytes = 0;
    for (const CacheEntry& entry : cache.entries()) bytes += entry.bytes;
    return bytes;
}

void setAge(const fs::path& file, std::chrono::seconds age) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - age);
}

class CacheUpkeep : public testing::Test {
protected:
    /// Entries 1 … n, entry i last used i hours ago.
    void fill(int n) const {
        for (int i = n; i >= 1; --i) {
            cache_.store(sample(keyOf(i)));
            setAge(cache_.entry(keyOf(i), someSources), hours(i));
        }
    }

    TemporaryFolder folder_;
    Cache cache_{folder_.path() / "references", std::uintmax_t{1} << 30};
};

TEST_F(CacheUpkeep, ListsEntriesWithTheMostRecentlyUsedFirst) {
    EXPECT_TRUE(cache_.entries().empty()); // the folder does not exist yet
    fill(3);
    const std::vector<CacheEntry> entries = cache_.entries();
    EXPECT_EQ(keys(entries), (std::vector{keyOf(1), keyOf(2), keyOf(3)}));
    EXPECT_EQ(entries[0].bytes, entryBytes);
}

TEST_F(CacheUpkeep, AHitIsAUse) {
    fill(3);
    ASSERT_TRUE(cache_.find(keyOf(3), someSources));
    EXPECT_EQ(cache_.entries().front().key, keyOf(3));
}

TEST_F(CacheUpkeep, CheckingIsNoUse) {
    fill(2);
    EXPECT_FALSE(damage(cache_.entries().back()));
    EXPECT_EQ(cache_.entries().back().key, keyOf(2));
}

TEST_F(CacheUpkeep, TheLeastRecentlyUsedGoUntilTheOthersFit) {
    fill(5);
    const Pruned pruned = cache_.prune({.maxBytes = 3 * entryBytes, .olderThan = {}});
    EXPECT_EQ(keys(pruned.entries), (std::vector{keyOf(5), keyOf(4)}));
    EXPECT_EQ(keys(cache_.entries()), (std::vector{keyOf(1), keyOf(2), keyOf(3)}));
}

TEST_F(CacheUpkeep, OldEntriesGo) {
    fill(4);
    EXPECT_EQ(cache_.prune({.maxBytes = {}, .olderThan = std::chrono::minutes(150)}).entries.size(), 2U);
    EXPECT_EQ(keys(cache_.entries()), (std::vector{keyOf(1), keyOf(2)}));
}

TEST_F(CacheUpkeep, WhatOtherCodeComputedGoesWhereThatIsAskedFor) {
    fill(2);
    Reference other = sample(keyOf(1));
    other.provenance.sources = otherSources;
    cache_.store(other);
    const fs::path older = cache_.folder() / keyOf(3).substr(0, 2) / (keyOf(3) + ".ref"); // of before names had sources
    fs::create_directories(older.parent_path());
    writeFile(older, encode(sample(keyOf(3))));
    EXPECT_EQ(cache_.entries().size(), 4U);
    const Pruned pruned = cache_.prune({.maxBytes = {}, .olderThan = {}, .sources = {{someSources}}});
    EXPECT_EQ(pruned.entries.size(), 2U);
    EXPECT_EQ(keys(cache_.entries()), (std::vector{keyOf(1), keyOf(2)}));
    EXPECT_EQ(cache_.entries().front().sources, someSources);
}

TEST_F(CacheUpkeep, ADryRunNamesTheSameAndRemovesNothing) {
    fill(4);
    const PruneRules rules{.maxBytes = entryBytes, .olderThan = {}};
    const std::vector<std::string> named = keys(cache_.prune(rules, true).entries);
    EXPECT_EQ(cache_.entries().size(), 4U);
    EXPECT_EQ(keys(cache_.prune(rules).entries), named);
    EXPECT_EQ(named.size(), 3U);
}

TEST_F(CacheUpkeep, AStoreKeepsToTheSizeAndRemovesTheLeastRecentlyUsed) {
    const Cache small(cache_.folder(), 3 * entryBytes + entryBytes / 2);
    fill(3);
    small.store(sample(keyOf(9)));
    EXPECT_EQ(keys(small.entries()), (std::vector{keyOf(9), keyOf(1), keyOf(2)}));
    ASSERT_TRUE(small.find(keyOf(2), someSources));
    small.store(sample(keyOf(8)));
    EXPECT_FALSE(small.find(keyOf(1), someSources));
    EXPECT_TRUE(small.find(keyOf(2), someSources));
}

TEST_F(CacheUpkeep, NeitherAnEntryBeingWrittenNorAnotherFileIsTouched) {
    fill(1);
    const fs::path group = cache_.entry(keyOf(1), someSources).parent_path();
    const fs::path young = group / fmt::format(".{}.shadowbench-aB3dE6.ref", keyOf(1)),
                   old = group / fmt::format(".{}.shadowbench-XyZ123.ref", keyOf(2));
    const std::vector<fs::path> others{cache_.folder() / "notes.txt", group / "notes.ref",
                                       cache_.folder() / (keyOf(3) + ".ref")};
    for (const fs::path& file : others) {
        writeFile(file, "not ours");
        setAge(file, hours(1000));
    }
    for (const fs::path& file : {young, old}) writeFile(file, "half an entry");
    setAge(old, std::chrono::minutes(61));

    const Pruned pruned = cache_.prune({.maxBytes = 0, .olderThan = {}});
    EXPECT_EQ(keys(pruned.entries), std::vector{keyOf(1)});
    EXPECT_EQ(pruned.leftovers, std::vector{old});
    EXPECT_TRUE(fs::exists(young));
    EXPECT_FALSE(fs::exists(old));
    for (const fs::path& file : others) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST_F(CacheUpkeep, ALinkToAFileOutsideIsNoEntry) {
    fill(1);
    const fs::path outside = folder_.path() / "outside.ref", link = cache_.entry(keyOf(2), someSources);
    writeFile(outside, "someone's");
    fs::create_directories(link.parent_path());
    fs::create_symlink(outside, link);
    EXPECT_EQ(cache_.prune({.maxBytes = 0, .olderThan = {}}).entries.size(), 1U);
    EXPECT_TRUE(fs::exists(link) && fs::exists(outside));
}

TEST_F(CacheUpkeep, DamageIsSaidInOneSentence) {
    fill(2);
    const fs::path file = cache_.entry(keyOf(2), someSources);
    std::string bytes = readFile(file);
    bytes[bytes.size() / 2] ^= 1;
    writeFile(file, bytes);
    for (const CacheEntry& entry : cache_.entries()) {
        EXPECT_EQ(damage(entry).has_value(), entry.key == keyOf(2));
        EXPECT_NE(damage(entry).value_or("checksum").find("checksum"), std::string::npos);
    }
    EXPECT_TRUE(fs::exists(file)); // looking repairs nothing
}

TEST_F(CacheUpkeep, AHeaderTellsTheProvenanceWithoutTheImages) {
    const std::string bytes = encode(sample(someKey));
    const EntryHeader header = decodeHeader(std::string_view(bytes).substr(0, bytes.find('\n') + 1));
    EXPECT_EQ(header.key, someKey);
    EXPECT_EQ(header.width, 5);
    EXPECT_EQ(header.height, 3);
    EXPECT_EQ(header.provenance.samples, 1024);
    EXPECT_THROW(decodeHeader("{}\n"), BadInput);
    EXPECT_THROW(decodeHeader(bytes.substr(0, 20)), BadInput);
}

/// An entry whose header has another value at `key`, and the checksum of that.
std::string withHeader(const std::string& from, const std::string& to) {
    std::string bytes = encode(sample(someKey));
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    bytes.replace(bytes.find(from), from.size(), to);
    const std::uint64_t sum = hash64(bytes);
    return bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

TEST(CacheEntry, WithAHeaderOfAnotherKindIsDamaged) {
    EXPECT_NO_THROW(decode(withHeader("\"version\":1", "\"version\":1"), someKey));
    const std::vector<std::pair<std::string, std::string>> changes{
        {"\"version\":1", "\"version\":\"1\""},      {"\"version\":1", "\"version\":[]"},
        {"\"format\":", "\"format\":7,\"former\":"}, {"\"width\":5", "\"width\":1e300"},
        {"\"height\":3", "\"height\":-3"},           {"\"height\":3", "\"height\":0"},
        {"\"samples\":1024", "\"samples\":1e300"},   {"\"width\":5", "\"width\":" + std::string(1000, '[')}};
    for (const auto& [from, to] : changes) EXPECT_THROW(decode(withHeader(from, to), someKey), BadInput) << to;
}

TEST(CacheEntry, WhoseProvenanceIsOfAnotherKeyIsDamaged) {
    EXPECT_THROW(decode(withHeader("\"provenance\":{\"key\":\"0", "\"provenance\":{\"key\":\"f"), someKey), BadInput);
}

/// What one process does to the cache: stores, looks for and prunes entries in an order of its own.
void useAsOneOfSeveral(const fs::path& folder, std::uintmax_t size, unsigned seed) {
    const Cache cache(folder, size);
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
        const int number = static_cast<int>(random() % 12);
        cache.store(sample(keyOf(number), static_cast<float>(number)));
        if (const auto found = cache.find(keyOf(static_cast<int>(random() % 12)), someSources);
            found && found->visibility.empty())
            throw InternalError("an entry without pixels");
        if (i % 10 == 9) cache.prune({.maxBytes = 2 * entryBytes, .olderThan = {}});
    }
}

TEST_F(CacheUpkeep, ProcessesThatStoreAndPruneTogetherLeaveAWholeSmallCache) {
    const std::uintmax_t size = 5 * entryBytes + 16; // keys differ in no byte's length, provenances neither
    std::vector<pid_t> children;
    for (unsigned i = 0; i < 4; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            try {
                useAsOneOfSeveral(cache_.folder(), size, i + 1);
                _exit(0);
            } catch (const std::exception& error) {
                fmt::print(stderr, "{}\n", error.what());
                _exit(1);
            }
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        int status = -1;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_LE(total(cache_), size);
    EXPECT_FALSE(cache_.entries().empty());
    for (const CacheEntry& entry : cache_.entries()) EXPECT_FALSE(damage(entry)) << entry.file;
    std::size_t files = 0;
    for (const auto& file : fs::recursive_directory_iterator(cache_.folder())) files += file.is_regular_file();
    EXPECT_EQ(files, cache_.entries().size()); // no temporary file left
}

TEST(CacheLimits, SizesAreNumbersWithPowersOf1024) {
    EXPECT_EQ(bytesOf("0"), 0U);
    EXPECT_EQ(bytesOf("1048576"), 1048576U);
    EXPECT_EQ(bytesOf("500M"), 500U << 20);
    EXPECT_EQ(bytesOf("4G"), std::uintmax_t{4} << 30);
    EXPECT_EQ(bytesOf("1.5 GiB"), std::uintmax_t{3} << 29);
    EXPECT_EQ(bytesOf("64kb"), 65536U);
    EXPECT_EQ(bytesOf("10B"), 10U);
    for (const char* wrong : {"", "G", "-1", "5X", "4GG", "nan", "inf", "1e9", "1 M B", "99999999T", "4G2"})
        EXPECT_THROW(bytesOf(wrong), BadInput) << wrong;
}

TEST(CacheLimits, TimeSpansAreNumbersWithAUnit) {
    EXPECT_EQ(durationOf("90s"), std::chrono::seconds(90));
    EXPECT_EQ(durationOf("30m"), std::chrono::minutes(30));
    EXPECT_EQ(durationOf("1.5h"), std::chrono::minutes(90));
    EXPECT_EQ(durationOf("30d"), hours(720));
    EXPECT_EQ(durationOf("2w"), hours(336));
    for (const char* wrong : {"", "30", "d", "-1d", "3 months", "1e3h", "99999999w"})
        EXPECT_THROW(durationOf(wrong), BadInput) << wrong;
}

TEST(CacheLimits, AreShownInTheUnitAPersonWouldTake) {
    EXPECT_EQ(bytesText(640), "640 B");
    EXPECT_EQ(bytesText(1900846), "1.8 MiB");
    EXPECT_EQ(bytesText(std::uintmax_t{4} << 30), "4.0 GiB");
    EXPECT_EQ(durationText(std::chrono::seconds(59)), "59 s");
    EXPECT_EQ(durationText(std::chrono::seconds(150)), "2 min");
    EXPECT_EQ(durationText(hours(47)), "1 d");
    EXPECT_EQ(durationText(hours(3)), "3 h");
}

TEST(CacheLimits, TheVariableSetsTheSizeAndAWrongOneIsNamed) {
    const char* before = std::getenv("SHADOWBENCH_CACHE_SIZE");
    const std::string saved = before != nullptr ? before : "";
    unsetenv("SHADOWBENCH_CACHE_SIZE");
    EXPECT_EQ(defaultCacheSize(), std::uintmax_t{4} << 30);
    setenv("SHADOWBENCH_CACHE_SIZE", "500M", 1);
    EXPECT_EQ(defaultCacheSize(), 500U << 20);
    setenv("SHADOWBENCH_CACHE_SIZE", "much", 1);
    try {
        defaultCacheSize();
        ADD_FAILURE() << "\"much\" is no size";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("SHADOWBENCH_CACHE_SIZE"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("500M"), std::string::npos) << error.what();
    }
    saved.empty() ? unsetenv("SHADOWBENCH_CACHE_SIZE") : setenv("SHADOWBENCH_CACHE_SIZE", saved.c_str(), 1);
}

} // namespace
} // namespace shadowbench::groundtruth
