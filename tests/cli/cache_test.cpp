// The cache verb as a user runs it.
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A cache with the four references of a tiny scene whose light moves: labels and pixel areas, of its last still and its
/// moving frame.
class CacheVerb : public testing::Test {
protected:
    CacheVerb() {
        const std::string scene = folder_.write(
            "tiny.toml", tinyScene("{ kind = \"point\", centre = [1.7, 6.1, -2.3], path = [{ frame = "
                                   "0, centre = [1.7, 6.1, -2.3] }, { frame = 1, centre = [1.8, 6.1, -2.3] }] }"));
        shell("shadowbench run --quiet --technique none --scene " + scene + " --out " + folder_ / "out" + where());
    }
    [[nodiscard]] std::string where() const { return " --cache " + folder_ / "cache"; }
    [[nodiscard]] Json json(const std::string& command) const {
        return Json::parse(shell("shadowbench cache " + command + " --json" + where()).output);
    }

    Folder folder_;
};

TEST_F(CacheVerb, ListNamesKeyOracleSizeSamplesBytesAndLastUse) {
    const Json listed = json("list");
    ASSERT_EQ(listed["entries"].size(), 4U); // labels and pixel areas of two frames
    int bytes = 0;
    std::multiset<std::string> oracles;
    for (const Json& entry : listed["entries"]) {
        bytes += entry["bytes"].get<int>();
        oracles.insert(entry["oracle"].get<std::string>());
    }
    EXPECT_EQ(listed["bytes"], bytes);
    EXPECT_EQ(oracles, (std::multiset<std::string>{"pixel-areas", "pixel-areas", "polygon+rays", "polygon+rays"}));
    const Json& entry = listed["entries"][0];
    EXPECT_EQ(entry["key"].get<std::string>().size(), 32U);
    EXPECT_EQ(entry["size"], Json({48, 48}));
    EXPECT_EQ(entry["samples"], 0);
    EXPECT_EQ(entry["last_use"].get<std::string>().size(), std::string("2026-01-01T00:00:00Z").size());
    const Outcome text = shell("shadowbench cache list" + where());
    EXPECT_NE(text.output.find(entry["key"].get<std::string>()), std::string::npos) << text.output;
    EXPECT_NE(text.output.find("4 references"), std::string::npos) << text.output;
}

TEST_F(CacheVerb, VerifyNamesTheDamagedFile) {
    EXPECT_EQ(shell("shadowbench cache verify --quiet" + where()).code, 0);
    std::string damaged;
    for (const auto& file : fs::recursive_directory_iterator(folder_ / "cache"))
        if (file.path().extension() == ".ref") damaged = file.path().string(); // beside them lie shaders
    fs::resize_file(damaged, fs::file_size(damaged) - 1);
    const Outcome outcome = shell("shadowbench cache verify --quiet" + where());
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.output.find(damaged), std::string::npos) << outcome.output;
    EXPECT_EQ(json("verify --quiet")["damaged"].size(), 1U);
}

TEST_F(CacheVerb, PruneRemovesWhatADryRunLists) {
    EXPECT_EQ(json("prune --all --dry-run")["removed"].size(), 4U);
    EXPECT_EQ(json("list")["entries"].size(), 4U);
    EXPECT_EQ(json("prune --older-than 1h")["removed"].size(), 0U);
    EXPECT_EQ(json("prune --max-size 100K")["removed"].size(), 3U); // an entry has 67 kB
    EXPECT_EQ(json("prune --all")["removed"].size(), 1U);
    EXPECT_EQ(json("list")["entries"].size(), 0U);
}

TEST_F(CacheVerb, PruneRemovesWhatThisProgramNeverReads) {
    EXPECT_EQ(json("prune")["removed"].size(), 0U);
    const Json entry = json("list")["entries"][0];
    const std::string key = entry["key"], sources = entry["sources"];
    const fs::path group = fs::path(folder_ / "cache") / key.substr(0, 2);
    fs::copy(group / (key + "." + sources + ".ref"), group / (key + ".0123456789ab.ref"));
    EXPECT_NE(shell("shadowbench cache list --quiet" + where()).output.find("; 1 that another program computed"),
              std::string::npos);
    EXPECT_EQ(shell("shadowbench cache verify --quiet" + where()).code, 0);
    EXPECT_EQ(json("prune")["removed"].at(0)["sources"], "0123456789ab");
    EXPECT_EQ(json("list")["entries"].size(), 4U);
}

TEST_F(CacheVerb, WrongArgumentsEndInOneLineThatSaysWhatIsValid) {
    const std::vector<std::pair<std::string, std::string>> wrong{{"lsit", "did you mean \"list\"?"},
                                                                 {"prune --max-size lots", "500M"},
                                                                 {"prune --older-than 30", "30d"},
                                                                 {"prune --all --max-size 1G", "excludes"},
                                                                 {"", "subcommand"}};
    for (const auto& [words, says] : wrong) {
        const Outcome outcome = shell("shadowbench cache " + words);
        EXPECT_EQ(outcome.code, 2) << words;
        EXPECT_NE(outcome.output.find(says), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(json("list")["entries"].size(), 4U);
}

TEST_F(CacheVerb, TheVariableBoundsTheCacheOfARun) {
    const std::string scene = folder_.write("other.toml", tinyScene("{ kind = \"point\", centre = [1.1, 5.9, -2.1] }"));
    const Outcome run = shell("SHADOWBENCH_CACHE_SIZE=100K shadowbench run --quiet --technique none --scene " + scene +
                              " --out " + folder_ / "out" + where());
    EXPECT_EQ(run.code, 0) << run.output;
    EXPECT_EQ(json("list")["entries"].size(), 1U);
}

} // namespace
} // namespace shadowbench
