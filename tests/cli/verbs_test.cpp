// The verbs as documented: what they print, what they write, what they return.
#include "harness/records/record.h"
#include "techniques/catalog.h"
#include "tests/support/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

TEST(CommandLine, HelpOfTheProgramAndOfEveryVerbHasAnExample) {
    EXPECT_EQ(shell("shadowbench --help").code, 0);
    for (const std::string verb : {"list", "run", "merge", "reference", "sweep", "recommend", "claims", "compare", "report",
                                   "cache", "cache list", "cache verify", "cache prune"}) {
        const Outcome help = shell("shadowbench " + verb + " --help");
        EXPECT_EQ(help.code, 0) << verb;
        EXPECT_NE(help.output.find("Example"), std::string::npos) << verb;
    }
}

TEST(CommandLine, ListNamesEveryTechniqueWithItsParameters) {
    const Outcome json = shell("shadowbench list techniques --format json");
    ASSERT_EQ(json.code, 0);
    const auto all = nlohmann::json::parse(json.output);
    ASSERT_EQ(all.size(), techniques::catalog().size());
    EXPECT_EQ(all[0]["id"], "none");
    const auto uniform = std::find_if(all.begin(), all.end(), [](const auto& entry) { return entry["id"] == "sm-uniform"; });
    ASSERT_NE(uniform, all.end());
    EXPECT_EQ((*uniform)["parameters"][0]["name"], "map");
    EXPECT_TRUE((*uniform)["figures"].empty());
    const auto pass = std::find_if(all.begin(), all.end(), [](const auto& entry) { return entry["id"] == "volume-zpass"; });
    ASSERT_NE(pass, all.end());
    EXPECT_EQ((*pass)["figures"][0]["name"], "volume_triangles");
    EXPECT_NE(shell("shadowbench list techniques").output.find("figures.stencil_bytes: bytes"), std::string::npos);
    EXPECT_NE(shell("shadowbench list scenes").output.find("dueling-frusta"), std::string::npos);
    EXPECT_NE(shell("shadowbench list metrics --format md").output.find("| mismatch |"), std::string::npos);
}

class Run : public testing::Test {
protected:
    [[nodiscard]] std::string command(const std::string& options) const {
        return "shadowbench run --quiet --scene " + scene_ + " --out " + folder_ / "out" + " --cache " + folder_ / "cache" +
               " " + options;
    }
    [[nodiscard]] std::vector<Record> records() const { return readRecords(folder_ / "out/results.jsonl"); }

    Folder folder_;
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
};

TEST_F(Run, WritesRecordsPageAndCharts) {
    const Outcome run = shell(command("--technique none --technique sm-uniform --technique volume-zfail --images"));
    ASSERT_EQ(run.code, 0) << run.output;
    EXPECT_NE(run.output.find("volume-zfail"), std::string::npos);
    ASSERT_EQ(records().size(), 3U);
    EXPECT_EQ(records()[2].variant, "volume-zfail");
    EXPECT_EQ(records()[2].status, Status::Scored);
    EXPECT_GT(*records()[0].values["accuracy.mismatch"],
              *records()[1].values["accuracy.mismatch"]); // no shadow is worse than a map
    EXPECT_TRUE(fs::exists(folder_ / "out/report.md"));
    EXPECT_TRUE(fs::exists(folder_ / "out/pareto-tiny.svg"));
    EXPECT_TRUE(fs::exists(folder_ / "out/images/tiny/sm-uniform/error.png"));
    EXPECT_TRUE(fs::exists(folder_ / "out/images/tiny/sm-uniform/visibility.exr"));
}

TEST_F(Run, SoftTechniquesDoNotApplyToAPointLight) {
    ASSERT_EQ(shell(command("--technique pcss")).code, 0);
    EXPECT_EQ(records()[0].status, Status::NotApplicable);
    EXPECT_NE(records()[0].reason.find("area light"), std::string::npos);
}

TEST_F(Run, TwiceTheSameGivesTheSameRecordsButForTimes) {
    const auto lines = [&] {
        EXPECT_EQ(shell(command("--cost none --technique sm-history --technique volume-zfail")).code, 0);
        std::vector<std::string> result;
        for (Record record : records()) {
            record.time.clear();
            result.push_back(toJson(record));
        }
        return result;
    };
    const auto first = lines();
    EXPECT_EQ(lines(), first);
}

TEST_F(Run, AResumedRunKeepsWhatIsFinished) {
    ASSERT_EQ(shell(command("--technique sm-uniform")).code, 0);
    const Record before = records()[0];
    ASSERT_EQ(shell(command("--resume --technique sm-uniform --technique none")).code, 0);
    ASSERT_EQ(records().size(), 2U);
    EXPECT_EQ(toJson(records()[0]), toJson(before)); // times and all: it was not run again
}

TEST_F(Run, KilledAtAnyMomentItLeavesWholeRecordsAndResumes) {
    for (const char* delay : {"0.2", "0.5", "0.9", "1.4"}) {
        shell("timeout -s KILL " + std::string(delay) + " " +
              command("--resume --technique sm-uniform --technique 'sm-h*' --technique pcf"));
        if (fs::exists(folder_ / "out/results.jsonl")) {
            EXPECT_NO_THROW(records());
        }
    }
    ASSERT_EQ(shell(command("--resume --technique sm-uniform --technique 'sm-h*' --technique pcf")).code, 0);
    EXPECT_EQ(records().size(), 6U); // a map, four variants of history, pcf
}

TEST_F(Run, ADamagedCacheEntryIsReplaced) {
    ASSERT_EQ(shell(command("--technique none")).code, 0);
    const double mismatch = *records()[0].values["accuracy.mismatch"];
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
        if (entry.is_regular_file()) fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    const Outcome again = shell(command("--technique none"));
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.output.find("damaged"), std::string::npos) << again.output;
    EXPECT_EQ(*records()[0].values["accuracy.mismatch"], mismatch);
}

TEST_F(Run, ReportIsMadeAgainFromRecordsAlone) {
    ASSERT_EQ(shell(command("--technique none --technique sm-uniform")).code, 0);
    const Outcome report = shell("shadowbench report " + folder_ / "out/results.jsonl" + " --out " + folder_ / "again");
    ASSERT_EQ(report.code, 0) << report.output;
    const auto text = [](const std::string& file) { return (std::ostringstream() << std::ifstream(file).rdbuf()).str(); };
    EXPECT_EQ(text(folder_ / "again/report.md"), text(folder_ / "out/report.md"));
    EXPECT_EQ(text(folder_ / "again/pareto-tiny.svg"), text(folder_ / "out/pareto-tiny.svg"));
}

} // namespace
} // namespace shadowbench
