// Bounds and the file that holds them.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "gate/bounds.h"
#include "gate/gate.h"
#include "gate/judged_cells.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

using test::hardRecord;

BoundRule bound(const std::string& technique, const std::string& metric, double value, bool below) {
    return {{"dueling-frusta", {technique}, {}, "a test"}, {metric, value, below}};
}

Record scoredRecord() {
    Record record = hardRecord();
    record.scene = "dueling-frusta";
    record.technique = "sm-uniform";
    record.variant = "sm-uniform";
    record.values["accuracy.leak"] = 0.02;
    return record;
}

TEST(Bounds, AreBrokenOnTheWrongSideOnly) {
    const auto direction = [](const BoundRule& b) { return judgeBounds({scoredRecord()}, {b}).at(0).direction; };
    EXPECT_EQ(direction(bound("sm-uniform", "leak", 0.03, true)), Direction::Same);
    EXPECT_EQ(direction(bound("sm-uniform", "leak", 0.01, true)), Direction::Worse);
    EXPECT_EQ(direction(bound("sm-*", "leak", 0.01, false)), Direction::Same) << "an expected failure that fails";
    EXPECT_EQ(direction(bound("sm-*", "leak", 0.03, false)), Direction::Worse) << "one that has stopped failing";
}

TEST(Bounds, OnAMetricThatIsMissingAreNotJudged) {
    const std::vector<Change> changes = judgeBounds({scoredRecord()}, {bound("sm-uniform", "penumbra_rmse", 1, true)});
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].direction, Direction::NotCompared);
    EXPECT_EQ(changes[0].changeClass, Class::Penumbra);
}

TEST(Bounds, ConcernNeitherSweepsNorWhatWasNotScored) {
    const BoundRule leak = bound("sm-uniform", "leak", 0.01, true);
    Record swept = scoredRecord(), failed = scoredRecord();
    swept.sweep = SweepStep{"near-plane", "m", "sm-uniform", 1, {}};
    failed.status = Status::Error;
    EXPECT_TRUE(judgeBounds({swept, failed}, {leak}).empty());
    EXPECT_EQ(judgeBounds({swept, failed, scoredRecord()}, {leak}).size(), 1U);
}

TEST(Bounds, MayBeOfOtherRenderersWhichOnlyTheirFileNames) {
    const GateConfig config = parseGateConfig("[[bound]]\nscene = \"dueling-frusta\"\ntechniques = [\"external:e*\"]\n"
                                              "metric = \"leak\"\nbelow = 0.01\nreason = \"a test\"\n",
                                              "bounds.toml", Profile::Gate);
    Record engine = scoredRecord(), other = scoredRecord();
    engine.technique = engine.variant = "external:engine";
    other.technique = other.variant = "external:other";
    const std::vector<Change> changes = judgeBounds({engine, other, scoredRecord()}, config.bounds);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].variant, "external:engine");
    EXPECT_EQ(changes[0].direction, Direction::Worse);
    EXPECT_NE(changes[0].sentence.find("leak is 0.02 and must be below 0.01"), std::string::npos) << changes[0].sentence;
}

TEST(Bounds, ConcernTheirCellsOnly) {
    Record elsewhere = scoredRecord();
    elsewhere.scene = "trees";
    BoundRule excepted = bound("sm-*", "leak", 0.01, true);
    excepted.cells.except = {"sm-uniform"};
    EXPECT_TRUE(judgeBounds({elsewhere}, {bound("sm-uniform", "leak", 0.01, true)}).empty());
    EXPECT_TRUE(judgeBounds({scoredRecord()}, {excepted}).empty());
    EXPECT_TRUE(judgeBounds({scoredRecord()}, {bound("still-to-come", "leak", 0.01, true)}).empty());
}

TEST(Bounds, HoldForEverySeed) {
    Record second = scoredRecord();
    second.seed = 2;
    second.values["accuracy.leak"] = 0.5;
    const std::vector<Change> changes = judgeBounds({scoredRecord(), second}, {bound("sm-uniform", "leak", 0.03, true)});
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].direction, Direction::Same);
    EXPECT_EQ(changes[1].direction, Direction::Worse);
}

TEST(Bounds, ThatMeetNothingAreNotJudgedWhereAllWasMeasured) {
    const BoundRule other = bound("still-to-come", "leak", 0.01, true);
    EXPECT_TRUE(judgeBounds({scoredRecord()}, {other}).empty());
    const std::vector<Change> changes =
        judgeBounds({scoredRecord()}, {other, bound("sm-uniform", "leak", 0.03, true)}, true);
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].direction, Direction::Same);
    EXPECT_EQ(changes[1].sentence, "still-to-come on dueling-frusta: the bound on leak met no result");
    EXPECT_EQ(changes[1].direction, Direction::NotCompared);
}

class GateConfigFile : public testing::Test {
protected:
    GateConfig read(const std::string& text) {
        writeFile(file_, text);
        return readGateConfig(file_, Profile::Gate);
    }
    std::string complaint(const std::string& text) {
        try {
            read(text);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "none";
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.path() / "bounds.toml";
};

TEST_F(GateConfigFile, HoldsBoundsSweepsAndCellsOfCost) {
    const GateConfig list = read("[[bound]]\nscene = \"trees\"\ntechniques = [\"volume-*\"]\nmetric = \"mismatch\"\nbelow = "
                                 "0.1\nreason = \"r\"\n[[sweep]]\nscene = \"trees\"\naxis = \"map\"\nvalues = [512, "
                                 "256]\ntechniques = [\"sm-uniform\"]\nreason = \"r\"\n[[time]]\nscene = "
                                 "\"trees\"\ntechniques = [\"*\"]\nexcept = [\"lod-*\"]\nreason = \"r\"\n");
    ASSERT_EQ(list.bounds.size(), 1U);
    EXPECT_TRUE(list.bounds[0].bound.below);
    ASSERT_EQ(list.sweeps.size(), 1U);
    EXPECT_EQ(list.sweeps[0].values, (std::vector<double>{512, 256}));
    ASSERT_EQ(list.timed.size(), 1U);
    EXPECT_TRUE(list.timed[0].covers("pcf:kernel=7"));
    EXPECT_FALSE(list.timed[0].covers("lod-blend"));
    EXPECT_TRUE(list.unknownScenes({}).empty());
}

TEST_F(GateConfigFile, NamesWhatIsWrongWithIt) {
    const std::string begin = "[[bound]]\nscene = \"trees\"\ntechniques = [\"sm-unifrom\"]\nmetric = \"mismatch\"\n";
    EXPECT_NE(complaint(begin + "below = 1\nreason = \"r\"\n").find("sm-uniform"), std::string::npos);
    const std::string good = "[[bound]]\nscene = \"trees\"\ntechniques = [\"pcf\"]\nmetric = \"mismatch\"\n";
    EXPECT_NE(complaint(good + "below = 1\n").find("reason"), std::string::npos);
    EXPECT_NE(complaint(good + "below = 1\nabove = 1\nreason = \"r\"\n").find("either"), std::string::npos);
    EXPECT_EQ(complaint(good + "below = 1\nreason = \"r\"\n"), "none");
}

TEST_F(GateConfigFile, NamesWhatNoListMayHold) {
    const std::string rule = "scene = \"trees\"\ntechniques = [\"pcf\"]\nreason = \"r\"\n";
    const std::vector<std::pair<std::string, std::string>> faults{
        {"[[bounds]]\n" + rule, "bounds: unknown key (did you mean \"bound\"?)"},
        {"[[scene]]\nscene = \"trees\"\ntechniques = []\nreason = \"r\"\n", "names no technique"},
        {"[[scene]]\nscene = \"trees\"\ntechniques = [\"pcf\"]\nreason = \"\"\n", "is empty; say it in a few words"},
        {"[[time]]\n" + rule + "except = [\"no-such\"]\n", "no-such"},
        {"[[count]]\n" + rule + "limit = 2\n", "limit: unknown key"},
        {"[[sweep]]\n" + rule, "axis"},
        {"[[sweep]]\n" + rule + "axis = \"near-plan\"\n", "near-plane"},
        {"[[sweep]]\n" + rule + "axis = \"near-plane\"\nvalues = [\"a\"]\n", "values"},
        {"[[bound]]\n" + rule + "metric = \"leek\"\nbelow = 1\n", "leak"},
        {"[[bound]]\n" + rule + "metric = \"leak\"\nbelow = -1\n", "below"},
        {"[[time]\n", "bounds.toml"}};
    for (const auto& [text, part] : faults) {
        EXPECT_NE(complaint(text).find(part), std::string::npos) << text << complaint(text);
        EXPECT_NE(complaint(text).find("bounds.toml:"), std::string::npos) << complaint(text);
    }
}

TEST_F(GateConfigFile, KnowsTheScenesThatNobodyHas) {
    const auto entry = [](const std::string& kind, const std::string& scene, const std::string& more = "") {
        return "[[" + kind + "]]\nscene = \"" + scene + "\"\ntechniques = [\"pcf\"]\nreason = \"r\"\n" + more;
    };
    const GateConfig list =
        read(entry("scene", "a") + entry("bound", "b", "metric = \"leak\"\nbelow = 1\n") +
             entry("sweep", "c", "axis = \"near-plane\"\n") + entry("count", "d") + entry("time", "e") + entry("time", "a") +
             entry("time", "trees") + entry("seeds", "seeds are measured where scenes are chosen"));
    EXPECT_EQ(list.unknownScenes({"d"}), (std::vector<std::string>{"a", "b", "c", "e"}));
    EXPECT_TRUE(list.unknownScenes({"a", "b", "c", "d", "e"}).empty());
}

TEST_F(GateConfigFile, SaysWhereChancePlaysAPart) {
    const GateConfig list = read("[[seeds]]\nscene = \"trees\"\ntechniques = [\"sm-history\", \"vsm\"]\n"
                                 "except = [\"vsm\"]\nreason = \"r\"\n");
    EXPECT_TRUE(list.isByChance("trees", "sm-history"));
    EXPECT_FALSE(list.isByChance("trees", "sm-history:m=15")) << "a name stands for one variant";
    EXPECT_FALSE(list.isByChance("trees", "vsm"));
    EXPECT_FALSE(list.isByChance("simple", "sm-history"));
}

TEST(GateRule, OfATechniqueStillToComeCoversNothing) {
    const GateRule rule{"trees", {"still-to-come", "sm-*", "pcf:kernel=7"}, {"sm-psm"}, "r"};
    EXPECT_FALSE(rule.covers("still-to-come"));
    EXPECT_EQ(rule.named(), std::vector<std::string>{"pcf:kernel=7"}) << "neither a glob nor what this build lacks";
    EXPECT_TRUE(rule.covers("sm-uniform:map=512"));
    EXPECT_TRUE(rule.excludes("sm-psm"));
    EXPECT_FALSE(rule.covers("sm-psm"));
}

TEST_F(GateConfigFile, TheCommittedOneIsSound) {
    const GateConfig list = readGateConfig(std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml", Profile::Gate);
    EXPECT_FALSE(list.bounds.empty());
    EXPECT_TRUE(list.unknownScenes({}).empty());
}

TEST(GatePlan, TheConfigsScenesComeWithTheirTechniquesUnlessTheUserNamesScenes) {
    GateOptions options;
    options.bounds = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    options.techniques = {"sm-cube", "pcf"};
    const JudgedCells cells(options);
    EXPECT_TRUE(cells.chooses("dueling-frusta", "pcf"));
    EXPECT_TRUE(cells.chooses("colonnade", "sm-cube"));
    EXPECT_FALSE(cells.chooses("colonnade", "pcf"));
    options.scenes = {"trees"};
    const JudgedCells narrow(options);
    EXPECT_TRUE(narrow.chooses("trees", "pcf"));
    EXPECT_FALSE(narrow.chooses("colonnade", "sm-cube"));
}

TEST(GatePlan, EveryBoundOnASceneThatIsJudgedMeetsACell) {
    GateOptions options;
    options.bounds = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    const JudgedCells cells(options);
    std::size_t met = 0;
    for (const BoundRule& bound : cells.policy.config.bounds) {
        const auto scene = std::ranges::find(cells.scenes, bound.cells.scene, &JudgedScene::id);
        if (scene == cells.scenes.end()) continue; // the tests of scenes hold it
        ++met;
        EXPECT_TRUE(std::ranges::any_of(scene->variants, [&](const std::string& v) { return bound.cells.covers(v); }))
            << bound.bound.metric << " on " << scene->id << " of " << bound.cells.techniques.front();
    }
    EXPECT_GT(met, 30U);
}

TEST(GatePlan, ASceneFileWithAMisspeltMetricIsRefusedAtItsLine) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "x.toml";
    std::string text(builtinSceneText("contact"));
    text.insert(text.find("[tolerance]\n") + 12, "missmatch = 0.1\n");
    writeFile(file, text);
    GateOptions options;
    options.bounds = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    options.scenes = {file.string()};
    try {
        const JudgedCells cells(options);
        FAIL() << "loaded";
    } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("x.toml:"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("tolerance.missmatch: unknown key (did you mean \"mismatch\"?)"),
                  std::string::npos)
            << error.what();
    }
}

TEST(BuiltinScenes, PutBoundsOnMetricsOfTheTable) {
    for (const std::string& id : builtinScenes())
        EXPECT_NO_THROW(loadScene(id, Profile::Gate, metrics::boundedMetrics())) << id;
}

TEST(GateCode, WhatCouldNotBeJudgedComesBeforeAccuracyAndThatBeforeCost) {
    GateResult result;
    EXPECT_EQ(result.code(), ExitCode::Pass);
    Change change{"trees", "pcf", "time.ratio", Class::Time, 1, 1.1, 0.01, Direction::Worse, "slower"};
    result.changes.push_back(change);
    EXPECT_EQ(result.code(), ExitCode::CostRegression);
    change.changeClass = Class::Leak;
    result.changes.push_back(change);
    EXPECT_EQ(result.code(), ExitCode::AccuracyRegression);
    result.notCompared.emplace_back("something");
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
    result.notCompared.clear();
    change.direction = Direction::NotCompared;
    result.changes.push_back(change);
    EXPECT_EQ(result.code(), ExitCode::Inconclusive);
}

TEST(GateReproduction, IsACommandForEachKindOfChange) {
    GateOptions options;
    options.base = "origin/main";
    Change change{"trees", "pcf:kernel=7", "m", Class::Leak, 1, 2, 0, Direction::Worse, ""};
    EXPECT_EQ(reproduction(change, options), "./bench run --images --cost none --out results/reproduced --scene trees "
                                             "--technique pcf:kernel=7 --profile gate --seed 1");
    change.changeClass = Class::BreakPoint;
    change.axis = "map";
    EXPECT_EQ(reproduction(change, options),
              "./bench sweep --axis map --scene trees --technique pcf:kernel=7 --profile gate --seed 1");
    change.changeClass = Class::Time;
    EXPECT_EQ(reproduction(change, options), "./bench gate --base origin/main --cost time --scene trees --technique "
                                             "pcf:kernel=7 --profile gate --seed 1");
}

} // namespace
} // namespace shadowbench::gate
