// The lock file of golden references: what it says is kept, what is none is refused by name.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/cells/golden_lock.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

const std::string text = R"({"format": "shadowbench golden references", "version": 1, "profile": "gate", "references": [
 {"scene": "simple", "truth": "soft", "frame": 59, "size": [256, 128], "key": "k", "oracle": "povray", "samples": 1024,
  "tools": {"povray": "3.7"}, "measured": {"primary_mismatch": 0.5}, "file": "simple-soft.exr",
  "hashes": {"visibility": "a", "sigma": "b", "surface": "c", "id": "d", "edge_distance": "e"}}]})";

std::string refusalOf(const std::string& from, const std::string& to) {
    std::string changed = text;
    try {
        parseLock(changed.replace(changed.find(from), from.size(), to), "a/lock.json");
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(GoldenLock, IsTheSameAfterItWasWrittenAndRead) {
    const TemporaryFolder folder;
    const GoldenLock lock = parseLock(text, "lock.json");
    ASSERT_EQ(lock.entries.size(), 1U);
    EXPECT_EQ(lock.entries[0].size, glm::ivec2(256, 128));
    EXPECT_EQ(lock.entries[0].provenance.samples, 1024);
    EXPECT_EQ(lock.find({"simple", Truth::Soft, 59})->file, "simple-soft.exr");
    EXPECT_EQ(lock.find({"simple", Truth::Hard, 59}), nullptr);
    writeLock(lock, folder.path());
    const std::string written = readFile(lockFile(folder.path()));
    writeLock(readLock(folder.path()), folder.path());
    EXPECT_EQ(readFile(lockFile(folder.path())), written);
}

TEST(GoldenLock, OfAnotherKindIsRefusedByName) {
    EXPECT_EQ(refusalOf("\"gate\"", "\"gate\""), "");
    const std::vector<std::pair<std::string, std::string>> changes{
        {"golden", "silver"},      {"\"version\": 1", "\"version\": 2"},
        {"\"gate\"", "\"goat\""},  {"\"soft\"", "\"software\""},
        {"59", "1e300"},           {"59", "5900000000"},
        {"256, 128", "256"},       {"256, 128", "1e300, 128"},
        {"1024", "\"1024\""},      {"simple-soft.exr", "../a.exr"},
        {"simple-soft.exr", ".."}, {"simple-soft.exr", "/etc/passwd"},
        {"[\n", "[[\n"},           {"{\"povray\"", fmt::format("{:[<1000}{{\"povray\"", "")}};
    for (const auto& [from, to] : changes)
        EXPECT_TRUE(refusalOf(from, to).starts_with("a/lock.json is no lock file of golden references: ")) << to;
}

} // namespace
} // namespace shadowbench
