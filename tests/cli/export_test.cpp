// `export` as a user types it, and its folder as the scene of other verbs.
#include "harness/records/record.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Export : public testing::Test {
protected:
    [[nodiscard]] std::vector<Record> recordsOf(const std::string& scene, const std::string& out) const {
        const Outcome run =
            shell("shadowbench run --quiet --cost none --technique sm-uniform --technique sm-history --scene " + scene +
                  " --out " + folder_ / out + " --cache " + folder_ / "cache");
        EXPECT_EQ(run.code, 0) << run.output;
        return readRecords(folder_ / out + "/results.jsonl");
    }
    [[nodiscard]] Outcome exported(const std::string& options = "") const {
        return shell("shadowbench export " + scene_ + " --out " + folder_ / "exported" + " " + options);
    }

    Folder folder_;
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
};

TEST_F(Export, TheFolderIsTheSameSceneForEveryRow) {
    ASSERT_EQ(exported("--quiet").output, "");
    const std::vector<Record> before = recordsOf(scene_, "before"), after = recordsOf(folder_ / "exported", "after");
    ASSERT_EQ(before.size(), 2U);
    ASSERT_EQ(after.size(), 2U);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(toJson(before[i]), toJson(after[i]));
    // Every truth was found under the key of the original: nothing was computed twice.
    const auto entries = std::distance(fs::directory_iterator(folder_ / "cache"), fs::directory_iterator());
    recordsOf(folder_ / "exported", "again");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "cache"), fs::directory_iterator()), entries);
}

TEST_F(Export, SaysWhatItWrote) {
    const Outcome outcome = exported("--json");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["scene"], "tiny");
    EXPECT_EQ(json["frames"], nlohmann::json::array({2, 3}));
    for (const auto& file : json["files"]) EXPECT_TRUE(fs::exists(folder_ / "exported/" + file.get<std::string>())) << file;
    EXPECT_NE(exported().output.find("tiny: frames 2, 3 in "), std::string::npos);
}

TEST_F(Export, BadInputIsOneLineAndNothingIsWritten) {
    const Outcome unknown = shell("shadowbench export stacked-plate --out " + folder_ / "exported");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_NE(unknown.output.find("did you mean \"stacked-plates\""), std::string::npos) << unknown.output;
    EXPECT_EQ(shell("shadowbench export " + scene_).code, 2); // no --out
    EXPECT_EQ(shell("shadowbench export --out " + folder_ / "exported").code, 2);
    EXPECT_FALSE(fs::exists(folder_ / "exported"));
}

TEST_F(Export, AFullDiskLeavesNothing) {
    const Outcome outcome =
        shell("trap '' XFSZ; ulimit -f 1; shadowbench export " + scene_ + " --out " + folder_ / "exported");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.output.find("cannot write"), std::string::npos) << outcome.output;
    EXPECT_FALSE(fs::exists(folder_ / "exported"));
}

} // namespace
} // namespace shadowbench
