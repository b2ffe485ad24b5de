// Whose policy judges, and which choices are tried.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "gate/choices.h"
#include "gate/judged_cells.h"
#include "gate/policy.h"
#include "gate/waivers.h"
#include "techniques/catalog.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace shadowbench::gate {
namespace {

BoundRule leakBelow(double value) { return {{"trees", {"pcf", "sm-uniform"}, {}, "a test"}, {"leak", value, true}}; }

Policy policyWith(const BoundRule& bound) {
    Policy policy;
    policy.standard = {"trees"};
    policy.config.bounds = {bound};
    return policy;
}

TEST(GatePolicy, ALooserBoundIsListedAndAStricterOneIsNot) {
    const Policy base = policyWith(leakBelow(0.1));
    EXPECT_TRUE(loosened(base, base).empty());
    EXPECT_TRUE(loosened(base, policyWith(leakBelow(0.05))).empty());
    const std::vector<std::string> sentences = loosened(base, policyWith(leakBelow(0.2)));
    ASSERT_EQ(sentences.size(), 1U);
    EXPECT_NE(sentences[0].find("pcf, sm-uniform on trees: leak below 0.1"), std::string::npos) << sentences[0];
    BoundRule above = leakBelow(0.1), lower = leakBelow(0.05);
    above.bound.below = lower.bound.below = false;
    EXPECT_EQ(loosened(policyWith(above), policyWith(lower)).size(), 1U) << "an expected failure";
    BoundRule fewer = leakBelow(0.1), except = leakBelow(0.1);
    fewer.cells.techniques = {"pcf"};
    except.cells.except = {"pcf"};
    EXPECT_EQ(loosened(base, policyWith(fewer)).size(), 1U);
    EXPECT_EQ(loosened(base, policyWith(except)).size(), 1U);
}

TEST(GatePolicy, ASweepThatAsksForLessIsListed) {
    const GateRule rule{"trees", {"pcf"}, {}, "a test"};
    Policy base, head;
    base.config.sweeps = {{rule, "map", {512, 256}}};
    const auto listed = [&] { return loosened(base, head); };
    head.config = base.config;
    head.config.sweeps[0].values = {512};
    EXPECT_EQ(listed(), std::vector<std::string>{"the base's [sweep] pcf on trees over map is gone or looser here"});
    head.config.sweeps[0] = {rule, "near-plane", {512, 256}};
    EXPECT_EQ(listed().size(), 1U);
    head.config.sweeps[0] = {{"simple", {"pcf"}, {}, "a test"}, "map", {512, 256}};
    EXPECT_EQ(listed().size(), 1U) << "another scene";
}

TEST(GatePolicy, ABoundOnAnotherMetricOrSideKeepsNothing) {
    const Policy base = policyWith(leakBelow(0.1));
    BoundRule other = leakBelow(0.05);
    other.bound.metric = "mismatch";
    EXPECT_EQ(loosened(base, policyWith(other)).size(), 1U);
    other = leakBelow(0.05);
    other.bound.below = false;
    EXPECT_EQ(loosened(base, policyWith(other)).size(), 1U);
}

TEST(GatePolicy, OfAnotherProfileLeavesOutWhatScenesExpectOfTheGates) {
    const std::filesystem::path file = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    EXPECT_LT(readPolicy(file, Profile::Standard).config.bounds.size(),
              readPolicy(file, Profile::Gate).config.bounds.size());
}

TEST(GatePolicy, OfAProgramThatIsOlderThanAKindOfEntryHasNone) {
    std::string json = toJson(BuildInfo{"c0ffee", false, "9a55", policyWith(leakBelow(0.1))});
    json.replace(json.find("\"waiver\""), 8, "\"a kind to come\"");
    EXPECT_TRUE(buildInfoFrom(json).policy.config.waivers.empty());
    EXPECT_EQ(buildInfoFrom(json).policy.config.bounds.size(), 1U);
    EXPECT_THROW(buildInfoFrom("no JSON"), BadInput);
}

TEST(GatePolicy, AnotherThingThatIsComparedOfAMetricIsListed) {
    const Rules base = ownRules();
    const std::string path = base.limits.begin()->first;
    for (const auto& change : std::vector<std::function<void(Limit&)>>{
             [](Limit& l) { l.of = "another class"; }, [](Limit& l) { l.magnitude = !l.magnitude; },
             [](Limit& l) { l.best += 0.5; }, [](Limit& l) { l.absent = metrics::Absent::AfterTheEnd; },
             [](Limit& l) { l.truth = metrics::TruthError::Rms; }}) {
        Rules head = base;
        change(head.limits.find(path)->second);
        EXPECT_EQ(loosened(base, head), std::vector<std::string>{"what is compared of " + path + " is another thing"});
    }
}

TEST(GatePolicy, EveryKindOfEntryThatIsGoneIsListedAndJudgesOn) {
    Policy base = policyWith(leakBelow(0.1));
    const GateRule rule{"trees", {"*"}, {}, "a test"};
    base.config.scenes = base.config.counted = base.config.timed = base.config.seeds = {rule};
    base.config.sweeps = {{rule, "map", {}}};
    base.config.choices = {rule};
    const Union both = unite(base, Policy());
    EXPECT_EQ(both.loosened.size(), 8U) << "and the standard scene";
    EXPECT_EQ(both.policy.standard, base.standard);
    EXPECT_EQ(both.policy.config.bounds.size(), 1U);
    EXPECT_EQ(both.policy.config.timed.size(), 1U);
    EXPECT_EQ(both.policy.config.choices.size(), 1U);
    EXPECT_TRUE(unite(both.policy, both.policy).loosened.empty());
}

TEST(GatePolicy, IsReadAsItIsWrittenAndMayNameWhatThisBuildLacks) {
    BuildInfo build{"c0ffee", true, "9a55", policyWith(leakBelow(0.1))};
    build.policy.config.bounds[0].bound.metric = "a-metric-to-come";
    build.policy.config.bounds[0].cells.techniques = {"a-technique-to-come"};
    build.policy.rules.limits["accuracy.to_come"] = {metrics::TruthError::Rms, 2, "accuracy.pixels.lit", 0.1, 0.2, true, 1};
    build.policy.time = {0.02, 0.07, 0.3, 0.002};
    const BuildInfo read = buildInfoFrom(toJson(build));
    EXPECT_EQ(toJson(read), toJson(build));
    const BuildInfo own = buildInfoFrom(toJson(ownBuildInfo()));
    EXPECT_EQ(own.reach.key("pcf", "trees"), Reach::own().key("pcf", "trees"));
    std::istringstream lines(toJson(own));
    for (std::string line; std::getline(lines, line);)
        EXPECT_LT(line.size(), 4096U) << "what reads a program's lines cuts them";
    EXPECT_TRUE(toJson(build).starts_with("{\n \"commit\": \"c0ffee\",\n")) << "for people, too";
    EXPECT_THROW(buildInfoFrom("{}"), BadInput);
    EXPECT_EQ(read.policy.rules.limits.at("accuracy.to_come").of, "accuracy.pixels.lit");
    EXPECT_EQ(read.policy.time.floor, 0.02);
    EXPECT_EQ(read.policy.time.wallFloor, 0.07);
    EXPECT_EQ(read.policy.time.mustTell, 0.3);
    EXPECT_EQ(read.policy.time.alpha, 0.002);
    EXPECT_TRUE(unite(read.policy, Policy()).policy.config.bounds.empty());
}

TEST(GatePolicy, OfThisBuildIsThatOfTheCommittedFile) {
    const Policy file = readPolicy(std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml", Profile::Gate);
    const Policy own = ownBuildInfo().policy;
    EXPECT_TRUE(loosened(own, file).empty());
    EXPECT_TRUE(loosened(file, own).empty());
    EXPECT_FALSE(own.standard.empty());
}

class GateUnion : public testing::Test {
protected:
    GateUnion() {
        writeFile(folder_.path() / "bounds.toml", "");
        options_.bounds = folder_.path() / "bounds.toml";
    }

    TemporaryFolder folder_;
    GateOptions options_;
};

TEST_F(GateUnion, TheBasesScenesAndVariantsAreJudgedToo) {
    Policy base;
    base.config.scenes = {{"colonnade", {"pcf"}, {}, "a test"}};
    const JudgedCells cells(options_, base, {"pcf:kernel=5,map=333", "sm-uniform"});
    EXPECT_TRUE(cells.chooses("colonnade", "pcf"));
    EXPECT_TRUE(cells.chooses("trees", techniques::parseVariant("pcf:kernel=5,map=333").name));
    EXPECT_EQ(cells.loosened.size(), 2U);
    EXPECT_TRUE(cells.gone.empty());
}

TEST_F(GateUnion, ARenamedSceneOrTechniqueIsNamed) {
    Policy base;
    base.standard = {"treees"};
    const JudgedCells cells(options_, base, {"sm-unifrom"});
    ASSERT_EQ(cells.gone.size(), 2U);
    EXPECT_EQ(cells.gone[0].sentence, "sm-unifrom, which the base shows, no longer exists");
    EXPECT_EQ(cells.gone[1].sentence, "the scene treees, which the base judges, no longer exists");
}

TEST_F(GateUnion, TheScenesOfTheBasesChoicesAreJudgedOrNamed) {
    Policy base;
    base.config.choices = {{"choices.toml", {"pcf"}, {}, "a test"}};
    ASSERT_EQ(JudgedCells(options_, base, {}).gone.size(), 1U);
    EXPECT_EQ(JudgedCells(options_, base, {}).gone[0].scene, "choices.toml");
    EXPECT_EQ(JudgedCells(options_, base, {}).gone[0].direction, Direction::NotCompared);
    std::filesystem::copy_file(std::filesystem::path(SOURCE_FOLDER) / "gate/scenes/choices-point.toml",
                               folder_.path() / "choices.toml");
    const JudgedCells cells(options_, base, {});
    EXPECT_TRUE(cells.gone.empty());
    EXPECT_TRUE(cells.chooses("choices", "pcf:kernel=3,filter=constant") ||
                std::ranges::any_of(cells.scenes, [](const JudgedScene& s) { return s.id == "choices"; }));
}

TEST_F(GateUnion, ASceneOfTwoEntriesIsMeasuredOnce) {
    Policy base;
    base.config.scenes = {{"colonnade", {"pcf"}, {}, "a test"}, {"colonnade", {"pcf", "sm-uniform"}, {}, "a test"}};
    const JudgedCells cells(options_, base, {});
    ASSERT_EQ(std::ranges::count(cells.scenes, "colonnade", &JudgedScene::id), 1);
    const auto scene = std::ranges::find(cells.scenes, "colonnade", &JudgedScene::id);
    EXPECT_EQ(std::ranges::count(scene->variants, "pcf"), 1);
    EXPECT_EQ(std::ranges::count(scene->variants, "sm-uniform"), 1);
}

TEST(GatePolicy, TheStricterRuleOfTimesJudges) {
    const Policy base;
    const auto united = [&](const TimeRule& rule) {
        Policy head;
        head.time = rule;
        return unite(base, head);
    };
    const TimeRule own;
    for (const TimeRule& looser : {TimeRule{2 * own.floor, own.wallFloor, own.mustTell, own.alpha},
                                   TimeRule{own.floor, 2 * own.wallFloor, own.mustTell, own.alpha},
                                   TimeRule{own.floor, own.wallFloor, 2 * own.mustTell, own.alpha},
                                   TimeRule{own.floor, own.wallFloor, own.mustTell, own.alpha / 2}}) {
        EXPECT_EQ(united(looser).loosened, std::vector<std::string>{"the rule of times is looser than the base's"});
        const TimeRule rule = united(looser).policy.time;
        EXPECT_EQ(rule.floor, own.floor);
        EXPECT_EQ(rule.wallFloor, own.wallFloor);
        EXPECT_EQ(rule.mustTell, own.mustTell);
        EXPECT_EQ(rule.alpha, own.alpha);
    }
    EXPECT_TRUE(united({own.floor / 2, own.wallFloor, own.mustTell, 2 * own.alpha}).loosened.empty());
    EXPECT_EQ(united({own.floor / 2, own.wallFloor, own.mustTell, own.alpha}).policy.time.floor, own.floor / 2);
}

const Waiver leaksUntilMay{"tre*", {"pcf*", "gone:map=3"}, "leak", "a test", "2026-05-31"};

TEST(Waivers, AcceptWhatIsOfTheirCellsAndClassThroughTheirLastDay) {
    const auto waived = [](const std::string& scene, const std::string& variant, Class what, Direction direction,
                           const std::string& today) {
        std::vector<Change> changes{{scene, variant, "m", what, 1, 2, 0, direction, "it leaks"}};
        waive(changes, {leaksUntilMay}, today);
        return changes[0].direction == Direction::Waived;
    };
    EXPECT_TRUE(waived("trees", "pcf", Class::Leak, Direction::Worse, "2026-05-31"));
    EXPECT_FALSE(waived("trees", "pcf", Class::Leak, Direction::Worse, "2026-06-01"));
    EXPECT_TRUE(waived("trees", "pcf", Class::Leak, Direction::NotCompared, "2026-01-01"));
    EXPECT_TRUE(waived("trees", "gone:map=3", Class::Leak, Direction::NotCompared, "2026-01-01"));
    EXPECT_FALSE(waived("simple", "pcf", Class::Leak, Direction::Worse, "2026-01-01"));
    EXPECT_FALSE(waived("trees", "esm", Class::Leak, Direction::Worse, "2026-01-01"));
    EXPECT_FALSE(waived("trees", "pcf", Class::Edge, Direction::Worse, "2026-01-01"));
    for (const Direction other : {Direction::Better, Direction::Same, Direction::Unclear})
        EXPECT_FALSE(waived("trees", "pcf", Class::Leak, other, "2026-01-01"));
}

TEST(Waivers, ThatAcceptNothingAreNamed) {
    std::vector<Change> changes;
    EXPECT_EQ(waive(changes, {leaksUntilMay}, "2026-01-01"),
              std::vector<std::string>{"the waiver \"a test\" accepts nothing: remove it"});
    EXPECT_EQ(waive(changes, {leaksUntilMay}, "2026-07-01"),
              std::vector<std::string>{"the waiver \"a test\" held until 2026-05-31 and accepts nothing now"});
}

TEST(Waivers, OfTheHeadAloneAreListed) {
    Policy with;
    with.config.waivers = {leaksUntilMay};
    ASSERT_EQ(loosened(Policy(), with).size(), 1U);
    EXPECT_TRUE(loosened(Policy(), with)[0].starts_with(
        "this build accepts, and its base does not, leak of pcf*, gone:map=3 on tre*"));
    EXPECT_TRUE(loosened(with, with).empty());
    EXPECT_TRUE(loosened(with, Policy()).empty());
    EXPECT_TRUE(unite(with, Policy()).policy.config.waivers.empty()) << "the head is held to more";
    EXPECT_EQ(buildInfoFrom(toJson(BuildInfo{"c0ffee", false, "9a55", with})).policy.config.waivers[0].expires,
              "2026-05-31");
}

TEST(Waivers, AreReadFromTheFileOfBounds) {
    const auto read = [](const std::string& day, const std::string& what) {
        return parseGateConfig("[[waiver]]\nscene = \"*\"\ntechniques = [\"gone\"]\nclass = \"" + what +
                                   "\"\nreason = \"a test\"\nexpires = \"" + day + "\"\n",
                               "bounds.toml", Profile::Gate);
    };
    EXPECT_EQ(read("2026-12-31", "false shadow").waivers.at(0).what, "false shadow");
    EXPECT_THROW(read("31.12.2026", "leak"), BadInput);
    EXPECT_THROW(read("2026-12-31", "no class"), BadInput);
}

TEST(GateChoices, EveryTwoChoicesComeTogether) {
    const std::vector<std::size_t> sizes{3, 2, 4, 2, 2};
    const auto always = [](const std::vector<std::size_t>& /*row*/) { return true; };
    const auto rows = pairwiseRows(sizes, always);
    std::set<std::vector<std::size_t>> pairs;
    for (const auto& row : rows)
        for (std::size_t a = 0; a < row.size(); ++a)
            for (std::size_t b = a + 1; b < row.size(); ++b) pairs.insert({a, row[a], b, row[b]});
    EXPECT_EQ(pairs.size(), 3U * 2 + 3 * 4 + 3 * 2 * 2 + 2 * 4 + 2 * 2 * 2 + 4 * 2 * 2 + 2 * 2);
    EXPECT_LE(rows.size(), 15U) << "of 96; 12 pairs of the two longest columns are the least";
    EXPECT_EQ(pairwiseRows({3}, always).size(), 3U);
    EXPECT_TRUE(pairwiseRows({}, always).empty());
}

TEST(GateChoices, WhatCannotBeMadeTakesNoOtherPairWithIt) {
    const std::vector<std::size_t> sizes{3, 2, 3};
    const auto goTogether = [](const std::vector<std::size_t>& row) { return row[0] != 0 || row[1] != 1; };
    std::set<std::vector<std::size_t>> pairs;
    for (const auto& row : pairwiseRows(sizes, goTogether)) {
        EXPECT_TRUE(goTogether(row));
        for (std::size_t a = 0; a < row.size(); ++a)
            for (std::size_t b = a + 1; b < row.size(); ++b) pairs.insert({a, row[a], b, row[b]});
    }
    EXPECT_EQ(pairs.size(), 3U * 2 - 1 + 3 * 3 + 2 * 3) << "all but the one that cannot be made";
}

TEST(GateChoices, OfARangeAreItsLeastAndItsDefault) {
    const auto choices = [](const techniques::Domain& domain, const std::string& usual) {
        techniques::Parameter parameter;
        parameter.domain = domain;
        parameter.defaultValue = usual;
        return choicesOf(parameter);
    };
    using Words = std::vector<std::string>;
    EXPECT_EQ(choices(techniques::OneOf{{"a", "b"}}, "b"), (Words{"a", "b"}));
    EXPECT_EQ(choices(techniques::IntegerRange{1, 9}, "3"), (Words{"3", "1"}));
    EXPECT_EQ(choices(techniques::IntegerRange{1, 9}, "1"), Words{"1"});
    EXPECT_EQ(choices(techniques::RealRange{0.5, 9}, "3"), (Words{"3", "0.5"}));
    EXPECT_EQ(choices(techniques::RealRange{0.5, 9}, "0.5"), Words{"0.5"});
}

TEST(GateChoices, OfATechniqueWithoutParametersIsItself) {
    const techniques::Entry& none = *techniques::parseVariant("none").entry;
    EXPECT_EQ(pairwiseVariants(none), std::vector<std::string>{"none"});
}

TEST(GateChoices, OfOneColumnThatGoTogetherWithNothingAreNone) {
    EXPECT_TRUE(pairwiseRows({3}, [](const auto&) { return false; }).empty());
    EXPECT_TRUE(pairwiseRows({2, 2}, [](const auto&) { return false; }).empty());
}

/// A technique that gets slower is seen only where its instructions are counted.
TEST(GateCounts, HoldEveryTechnique) {
    GateOptions options;
    options.bounds = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    const JudgedCells cells(options);
    std::set<std::string> counted;
    for (const JudgedScene& scene : cells.scenes)
        for (const std::string& name : scene.variants)
            for (const GateRule& rule : cells.policy.config.counted)
                if (rule.scene == scene.id && rule.covers(name)) counted.insert(techniques::parseVariant(name).entry->id);
    for (const techniques::Entry& entry : techniques::catalog()) EXPECT_TRUE(counted.contains(entry.id)) << entry.id;
}

TEST(GateCounts, AVariantThatIsNamedIsMeasuredWhereItsTechniqueIsChosen) {
    const TemporaryFolder folder;
    GateOptions options;
    options.bounds = folder.path() / "bounds.toml";
    writeFile(options.bounds, R"([[count]]
scene = "dueling-frusta"
techniques = ["sm-*", "vsm:map=512"]
except = ["vsm"]
reason = "cheaper"
)");
    options.scenes = {"dueling-frusta"};
    options.techniques = {"vsm"};
    EXPECT_EQ(JudgedCells(options).scenes.front().variants, (std::vector<std::string>{"vsm", "vsm:map=512"}));
    options.techniques = {"sm-uniform"};
    EXPECT_EQ(JudgedCells(options).scenes.front().variants, std::vector<std::string>{"sm-uniform"});
}

/// Every word that a parameter takes, of all techniques, is in a variant of the gate's choices.
TEST(GateChoices, HoldEveryChoiceOfEveryTechnique) {
    GateOptions options;
    options.bounds = std::filesystem::path(SOURCE_FOLDER) / "gate/bounds.toml";
    const JudgedCells cells(options);
    std::set<std::string> tried; // "pcf kernel=9"
    for (const JudgedScene& scene : cells.scenes)
        for (const std::string& name : scene.variants) {
            const techniques::Variant variant = techniques::parseVariant(name);
            for (const auto& [parameter, value] : variant.parameters.all())
                tried.insert(variant.entry->id + " " + parameter + "=" + value);
        }
    for (const techniques::Entry& entry : techniques::catalog())
        for (const techniques::Parameter& parameter : entry.parameters) {
            if (!std::holds_alternative<techniques::OneOf>(parameter.domain)) continue;
            for (const std::string& word : choicesOf(parameter))
                EXPECT_TRUE(tried.contains(entry.id + " " + parameter.name + "=" + word))
                    << entry.id << ":" << parameter.name << "=" << word;
        }
}

} // namespace
} // namespace shadowbench::gate
