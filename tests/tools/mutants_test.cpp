// The suite of planted faults fits the tree as it is: it cannot rot until somebody runs it.
#include "tools/mutants/mutant.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "gate/reach.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "techniques/variant_name.h"
#include "tests/support/records_examples.h"
#include "tools/mutants/outcome.h"
#include "tools/mutants/sources.h"
#include "tools/mutants/tree_copy.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace shadowbench::mutants {
namespace {

const std::filesystem::path root = SOURCE_FOLDER;

std::vector<Mutant> all() { return readMutants(root / "tools/mutants/mutants.toml"); }

Mutant example() {
    Mutant mutant;
    mutant.id = "example";
    mutant.file = "a.cpp";
    mutant.find = "x + 1";
    mutant.replace = "x - 1";
    mutant.techniques = {"sm-history"};
    mutant.expected = gate::Class::Labels;
    return mutant;
}

/// The error of a list that holds `lines`.
std::string refusal(const std::string& lines) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "list.toml", "[[mutant]]\n" + lines);
    try {
        readMutants(folder.path() / "list.toml");
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

const std::string withoutClass = "id = 'a'\nwhat = 'w'\nfile = 'f'\nfind = 'x'\nreplace = 'y'\ntechniques = ['pcf']\n";

TEST(Mutants, EveryOneCanBePlantedAndChangesItsFile) {
    for (const Mutant& mutant : all()) {
        const std::string source = readFile(root / mutant.file);
        EXPECT_NO_THROW(EXPECT_NE(planted(mutant, source), source) << mutant.id) << mutant.id;
    }
}

/// The unit that holds a file: the folder of a technique, the file itself, or "*".
std::string unitOf(const std::string& file, const std::set<std::string>& units) {
    const std::string name = file.starts_with("techniques/") ? file.substr(std::string("techniques/").size()) : file;
    for (const std::string& unit : units)
        if (name == unit || name.starts_with(unit + "/")) return unit;
    return "*";
}

TEST(Mutants, EveryOneIsPlantedWhereTheGateMeasuresWhatFindsIt) {
    std::set<std::string> units;
    for (const techniques::Entry& entry : techniques::catalog())
        for (const std::string& scene : builtinScenes()) units.merge(gate::Reach::own().units(entry.id, scene));
    for (const Mutant& mutant : all()) {
        if (mutant.means == Means::Test || mutant.means == Means::Truth) continue;
        for (const std::string& variant : mutant.techniques) {
            const std::string scene = mutant.scenes.empty() ? "trees" : mutant.scenes.front();
            const std::set<std::string> reached =
                gate::Reach::own().units(std::string(techniques::idOfVariant(variant)), scene);
            EXPECT_TRUE(reached.contains(unitOf(mutant.file, units))) << mutant.id << ": " << variant;
        }
    }
}

TEST(Mutants, EveryOneRunsWhatThereIs) {
    const std::vector<std::string> known = builtinScenes();
    for (const Mutant& mutant : all()) {
        for (const std::string& variant : mutant.techniques) EXPECT_NO_THROW(techniques::parseVariant(variant)) << mutant.id;
        for (const std::string& scene : mutant.scenes)
            EXPECT_NE(std::find(known.begin(), known.end(), scene), known.end()) << mutant.id << ": " << scene;
        const std::string test = fmt::format("tests/{}_test.cpp", mutant.target);
        EXPECT_TRUE(mutant.means != Means::Test || std::filesystem::exists(root / test)) << mutant.id;
        const std::string scene = mutant.target.substr(0, mutant.target.find('/'));
        EXPECT_TRUE(mutant.means != Means::Truth || std::ranges::count(known, scene) == 1) << mutant.id;
    }
}

TEST(Mutants, ThereAreAsManyAsTheGateHasToBeShownTo) {
    std::set<std::string> techniques;
    std::set<gate::Class> classes;
    int faults = 0, slowdowns = 0, harness = 0, benign = 0, shaders = 0, benignShaders = 0;
    for (const Mutant& mutant : all()) {
        if (mutant.expected) classes.insert(*mutant.expected);
        if (mutant.means == Means::Shader) {
            ++(mutant.benign ? benignShaders : shaders);
            continue;
        }
        const bool inTechniques = mutant.file.string().starts_with("techniques/");
        ++(mutant.benign ? benign : mutant.isSlowdown() ? slowdowns : inTechniques ? faults : harness);
        if (mutant.isSlowdown() || mutant.benign) continue;
        for (const std::string& variant : mutant.techniques) techniques.insert(variant.substr(0, variant.find(':')));
    }
    EXPECT_GE(faults, 25);
    EXPECT_GE(harness, 40);
    EXPECT_GE(benign, 15);
    EXPECT_GE(techniques.size(), 10U);
    EXPECT_GE(slowdowns, 8);
    EXPECT_GE(shaders, 10);
    EXPECT_GE(benignShaders, 20);
    EXPECT_EQ(classes.size(), 11U); // all but the status of a cell
}

TEST(Mutants, ATextThatIsMissingOrAmbiguousIsAnErrorThatNamesTheMutant) {
    EXPECT_EQ(planted(example(), "y = x + 1;"), "y = x - 1;");
    for (const std::string source : {"y = x;", "y = x + 1 - (x + 1);"}) {
        try {
            planted(example(), source);
            FAIL() << source;
        } catch (const BadInput& error) {
            EXPECT_NE(std::string(error.what()).find("example"), std::string::npos);
        }
    }
}

TEST(Mutants, AListWithAFaultOfItsOwnIsRefused) {
    EXPECT_EQ(refusal(withoutClass + "class = 'leak'\n"), "");
    EXPECT_NE(refusal(withoutClass + "class = 'leaks'\n").find("did you mean \"leak\""), std::string::npos);
    EXPECT_NE(refusal(withoutClass).find("class"), std::string::npos);
    EXPECT_NE(refusal(withoutClass + "class = 'leak'\nscene = 'simple'\n").find("scene"), std::string::npos);
    EXPECT_NE(refusal(withoutClass + "class = 'break point'\nsweep = { axis = 'map', values = [1] }\n").find("one scene"),
              std::string::npos);
    EXPECT_EQ(refusal(withoutClass + "benign = true\n"), "");
    EXPECT_NE(refusal(withoutClass + "benign = true\nclass = 'leak'\n").find("class"), std::string::npos);
    EXPECT_NE(refusal(withoutClass + "detected_by = 'luck'\n").find("refusal"), std::string::npos);
    EXPECT_NE(refusal(withoutClass + "detected_by = 'test:harness/metrics/accuracy'\n").find("techniques"),
              std::string::npos);
    EXPECT_NE(
        refusal(withoutClass + "class = 'leak'\n[[mutant]]\n" + withoutClass + "class = 'leak'\n").find("two of \"a\""),
        std::string::npos);
}

TEST(Mutants, GlobsChooseAndOneThatMatchesNothingIsAnError) {
    Mutant other = example();
    other.id = "other";
    EXPECT_EQ(matching({example(), other}, {}).size(), 2U);
    EXPECT_EQ(matching({example(), other}, {"ex*", "*ple"}).size(), 1U);
    EXPECT_THROW(matching({example(), other}, {"pcf*"}), BadInput);
}

TEST(Mutants, ShardsHoldEachOnce) {
    Mutant other = example(), third = example();
    other.id = "other";
    third.id = "third";
    const std::vector<Mutant> first = shardOf({example(), other, third}, "1/2");
    ASSERT_EQ(first.size(), 2U);
    EXPECT_EQ(first[1].id, "third");
    EXPECT_EQ(shardOf({example(), other, third}, "2/2").size(), 1U);
    for (const char* none : {"", "2", "0/2", "3/2", "1/2/3", "a/b"}) EXPECT_THROW(shardOf({example()}, none), BadInput);
}

TEST(Mutants, AResultHangsOnWhatItsProgramIsMadeOf) {
    const std::string layers = "base: | x\nscene: base\ntechniques/a: base\ntechniques/b: base\ntechniques/contract: base\n"
                               "techniques: techniques/a techniques/b techniques/contract base\n"
                               "harness/metrics: base\nharness/records: harness/metrics\n"
                               "harness/cells: techniques harness/records scene\ngate: harness/cells\n";
    const std::vector<std::string> files{"base/a.cpp",
                                         "gate/b.cpp",
                                         "harness/metrics/c.cpp",
                                         "harness/records/compare.cpp",
                                         "scene/library/other.toml",
                                         "scene/library/simple.toml",
                                         "techniques/a/sm-history/d.cpp",
                                         "techniques/b/other/e.cpp",
                                         "techniques/variant.cpp",
                                         "tests/harness/metrics/accuracy_test.cpp",
                                         "tests/harness/metrics/other_test.cpp"};
    Mutant mutant = example();
    mutant.scenes = {"simple"};
    EXPECT_EQ(sourcesThatMatter(mutant, files, layers),
              (std::vector<std::string>{"base/a.cpp", "harness/metrics/c.cpp", "scene/library/simple.toml",
                                        "techniques/a/sm-history/d.cpp", "techniques/variant.cpp"}));
    mutant.means = Means::Test;
    mutant.target = "harness/metrics/accuracy";
    EXPECT_EQ(sourcesThatMatter(mutant, files, layers),
              (std::vector<std::string>{"base/a.cpp", "harness/metrics/c.cpp", "tests/harness/metrics/accuracy_test.cpp"}));
}

TEST(Mutants, OneWithoutScenesRunsOnThoseThatTheGateJudgesItsTechniquesOn) {
    gate::GateConfig config;
    config.scenes = {{"moving-caster", {"sm-history", "temporal-soft"}, {}, "trails"},
                     {"colonnade", {"sm-cube"}, {}, "all sides"}};
    Mutant withOwn = example();
    withOwn.scenes = {"simple"};
    std::vector<std::string> expected = standardScenes();
    expected.emplace_back("moving-caster");
    const std::vector<Mutant> mutants = onTheGatesScenes({example(), withOwn}, config);
    EXPECT_EQ(mutants[0].scenes, expected);
    EXPECT_EQ(mutants[1].scenes, std::vector<std::string>{"simple"});
}

TEST(Mutants, FaultsRunWithoutTimeAndSlowdownsAreCounted) {
    Mutant mutant = example();
    EXPECT_EQ(arguments(mutant),
              (std::vector<std::string>{"run", "--quiet", "--technique", "sm-history", "--cost", "none"}));
    mutant.expected = gate::Class::Instructions;
    EXPECT_EQ(arguments(mutant).back(), "instructions");
    mutant.scenes = {"simple"};
    mutant.sweep = Sweep{"map", {512, 256}};
    EXPECT_EQ(arguments(mutant), (std::vector<std::string>{"sweep", "--quiet", "--technique", "sm-history", "--scene",
                                                           "simple", "--axis", "map", "--values", "512,256"}));
    mutant.means = Means::Truth;
    mutant.target = "simple/soft/60";
    EXPECT_EQ(arguments(mutant), (std::vector<std::string>{"reference", "--verify", "--quiet", "--scene", "simple",
                                                           "--truth", "soft", "--frame", "60"}));
}

Trial recorded(const Record& record) { return {{record}, ""}; }

TEST(Mutants, OnlyTheExpectedClassCounts) {
    Mutant mutant = example();
    mutant.expected = gate::Class::Leak;
    const Record base = test::hardRecord();
    Record head = base;
    EXPECT_FALSE(outcomeOf(mutant, recorded(base), recorded(head)).caught());
    head = test::drawnAnew(head);
    head.values["accuracy.false_shadow"] = 0.5;
    const Outcome elsewhere = outcomeOf(mutant, recorded(base), recorded(head));
    EXPECT_TRUE(elsewhere.caught());
    EXPECT_FALSE(elsewhere.caughtInClass());
    head.values["accuracy.leak"] = 0.01;
    const Outcome caught = outcomeOf(mutant, recorded(base), recorded(head));
    EXPECT_TRUE(caught.caughtInClass());
    EXPECT_EQ(strongest(caught)->metric, "accuracy.leak"); // though false shadow grew more
}

TEST(Mutants, OfAShaderTheExpectedPassCounts) {
    const auto costs = [](double executed) {
        shaders::ShaderCost cost{};
        cost.technique = "vsm";
        cost.pass = "resolve";
        cost.stage = gpu::Stage::Fragment;
        cost.source = "vsm.frag";
        cost.architecture = "navi21";
        cost.executed = gpu::Executed{executed, executed, 0, 0, 0, 0, 0};
        return Trial{{}, "", {"radv", {cost}}};
    };
    Mutant mutant = example();
    mutant.means = Means::Shader;
    mutant.expected = gate::Class::Shader;
    mutant.pass = "resolve";
    EXPECT_EQ(verdict(outcomeOf(mutant, costs(1000), costs(1010))), "caught");
    EXPECT_EQ(verdict(outcomeOf(mutant, costs(1000), costs(1001))), "**survives**");
    mutant.pass = "blur";
    EXPECT_EQ(verdict(outcomeOf(mutant, costs(1000), costs(1010))), "caught in another class");
    mutant.benign = true;
    EXPECT_EQ(verdict(outcomeOf(mutant, costs(1000), costs(1001))), "green");
    EXPECT_EQ(verdict(outcomeOf(mutant, costs(1000), costs(1010))), "**false red**");
    EXPECT_EQ(arguments(mutant), (std::vector<std::string>{"shader-cost", "--quiet", "--technique", "sm-history"}));
}

TEST(Mutants, ARefusalIsADetectionAndOfABenignChangeAFalseRed) {
    Mutant mutant = example();
    mutant.means = Means::Refusal;
    const Record base = test::hardRecord();
    Record otherTruth = base, error = base;
    otherTruth.reference->key = "0123456789abcdef0123456789abcdef";
    error.status = Status::Error;
    error.reason = "the rasteriser and the ground truth disagree";
    EXPECT_FALSE(outcomeOf(mutant, recorded(base), recorded(base)).caught());
    EXPECT_TRUE(outcomeOf(mutant, recorded(base), recorded(otherTruth)).caughtInClass());
    EXPECT_TRUE(outcomeOf(mutant, recorded(base), recorded(error)).caughtInClass());
    EXPECT_TRUE(outcomeOf(mutant, recorded(base), {{}, "no camera"}).caughtInClass());
    mutant.means = Means::Gate;
    mutant.benign = true;
    EXPECT_TRUE(outcomeOf(mutant, recorded(base), recorded(base)).asExpected());
    EXPECT_FALSE(outcomeOf(mutant, recorded(base), recorded(otherTruth)).asExpected());
}

TEST(Mutants, TheReportCountsSharesAndNamesSurvivorsWithTheirReason) {
    Mutant leak = example(), survivor = example(), slow = example(), metric = example(), benign = example();
    leak.file = survivor.file = slow.file = benign.file = "techniques/a.cpp";
    leak.expected = gate::Class::Leak;
    survivor.id = "survivor";
    survivor.survives = "equal to the bit";
    slow.expected = gate::Class::Instructions;
    metric.means = Means::Test;
    metric.target = "harness/metrics/accuracy";
    benign.benign = true;
    const Record base = test::hardRecord();
    Record leaking = test::drawnAnew(base);
    leaking.values["accuracy.leak"] = 0.01;
    const Record counted = test::softRecord();
    Record slower = counted;
    slower.values["cost.instructions"] = *counted.values["cost.instructions"] * 103 / 100;
    const std::string report = mutantsReport(
        {outcomeOf(leak, recorded(base), recorded(leaking)), outcomeOf(survivor, recorded(base), recorded(base)),
         outcomeOf(slow, recorded(counted), recorded(slower)), outcomeOf(metric, {}, {{}, "Leak.IsAShare failed"}),
         outcomeOf(benign, recorded(base), recorded(base))},
        "commit c0ffee");
    for (const char* line :
         {"in 1 techniques: 1 of 2 (50 %) caught in the class",
          "All faults and slowdowns: 3 of 4 (75 %) detected as expected",
          "Slowdowns: 1 of 1 (100 %) caught by instructions; of 1 % or more, 1 of 1", "+3.00 %",
          "**survivor**: equal to the bit", "Leak.IsAShare failed", "Benign changes: 0 of 1 (0 %) red", "| test | 1 | 1 |"})
        EXPECT_NE(report.find(line), std::string::npos) << line << "\n" << report;
}

} // namespace
} // namespace shadowbench::mutants
