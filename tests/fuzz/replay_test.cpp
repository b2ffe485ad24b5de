// What fuzzers have kept (tests/fuzz/corpus: inputs that reach different code, and all that was ever found), read once more.
#include "base/error.h"
#include "base/files.h"
#include "tests/fuzz/target.h"
#include "tests/fuzz/tokens.h"

#include <filesystem>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <set>

namespace shadowbench::fuzz {
namespace {
namespace fs = std::filesystem;

const fs::path corpus = SOURCE_FOLDER "/tests/fuzz/corpus";

class Replay : public testing::TestWithParam<Target> {};

TEST_P(Replay, EveryKeptInputIsTakenOrRefusedInOneSentence) {
    int taken = 0, all = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(corpus / GetParam().name)) {
        const std::string input = readFile(entry.path());
        EXPECT_NO_THROW(taken += isTaken([&] { GetParam().read(input); })) << entry.path();
        ++all;
    }
    EXPECT_GT(all, 0);
    EXPECT_GT(taken, 0) << "nothing gets through: the corpus tests an error message";
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Replay, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(Targets, HaveACorpusEachAndThereIsNoOther) {
    std::set<std::string> folders, names;
    std::uintmax_t bytes = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(corpus)) {
        if (entry.is_directory()) folders.insert(entry.path().filename().string());
        if (entry.is_regular_file()) bytes += entry.file_size();
    }
    for (const Target& target : targets()) names.emplace(target.name);
    EXPECT_EQ(folders, names);
    EXPECT_LT(bytes, 500'000U) << "keep it small: tools/fuzz --keep";
}

TEST(Targets, RefuseNothingWithoutASentence) {
    EXPECT_TRUE(isTaken([] {}));
    EXPECT_FALSE(isTaken([] { throw BadInput("it is bad"); }));
    EXPECT_FALSE(isTaken([] { throw Inconclusive("it is missing"); }));
    EXPECT_THROW(isTaken([] { throw BadInput(""); }), std::logic_error);
    EXPECT_THROW(isTaken([] { throw InternalError("it is ours"); }), InternalError);
    EXPECT_THROW(isTaken([] { throw std::out_of_range("at"); }), std::out_of_range);
    EXPECT_THROW(targetNamed("scenes"), BadInput);
}

TEST(Tokens, AreTheTextAndChangesOfThemTheSameForTheSameSeed) {
    const std::string text = "key = [1.5e3, 'a', \"b\\\"c\"] # x\n\"cut";
    const std::vector<std::string_view> tokens = tokensOf(text);
    EXPECT_EQ(fmt::format("{}", fmt::join(tokens, "")), text);
    const std::set<std::string_view> all(tokens.begin(), tokens.end());
    for (const char* token : {"key", "1.5e3", "'a'", "\"b\\\"c\"", "\n", "cut"}) EXPECT_TRUE(all.contains(token)) << token;
    std::set<std::string> different;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        EXPECT_EQ(changed(text, seed), changed(text, seed));
        different.insert(changed(text, seed));
    }
    EXPECT_GT(different.size(), 80U);
    EXPECT_FALSE(changed("", 1).empty());
}

} // namespace
} // namespace shadowbench::fuzz
