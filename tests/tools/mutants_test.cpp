// The suite of planted faults fits the tree as it is: it cannot rot until somebody runs it.
#include "tools/mutants/mutant.h"

#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"
#include "tests/support/records_examples.h"
#include "tools/mutants/outcome.h"
#include "tools/mutants/tree_copy.h"

#include <algorithm>
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

TEST(Mutants, EveryOneRunsWhatThereIs) {
    const std::vector<std::string> known = builtinScenes();
    for (const Mutant& mutant : all()) {
        for (const std::string& variant : mutant.techniques) EXPECT_NO_THROW(techniques::parseVariant(variant)) << mutant.id;
        for (const std::string& scene : mutant.scenes)
            EXPECT_NE(std::find(known.begin(), known.end(), scene), known.end()) << mutant.id << ": " << scene;
    }
}

TEST(Mutants, ThereAreAsManyAsTheGateHasToBeShownTo) {
    std::set<std::string> techniques;
    std::set<gate::Class> classes;
    int faults = 0, slowdowns = 0;
    for (const Mutant& mutant : all()) {
        classes.insert(mutant.expected);
        ++(mutant.isSlowdown() ? slowdowns : faults);
        if (mutant.isSlowdown()) continue;
        for (const std::string& variant : mutant.techniques) techniques.insert(variant.substr(0, variant.find(':')));
    }
    EXPECT_GE(faults, 25);
    EXPECT_GE(techniques.size(), 10U);
    EXPECT_GE(slowdowns, 8);
    EXPECT_EQ(classes.size(), 9U); // all but the status of a cell
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

TEST(Mutants, OneWithoutScenesRunsOnThoseThatTheGateJudgesItsTechniquesOn) {
    gate::Watchlist watchlist;
    watchlist.scenes = {{"moving-caster", {"sm-history", "temporal-soft"}, {}, "trails"},
                        {"colonnade", {"sm-cube"}, {}, "all sides"}};
    Mutant withOwn = example();
    withOwn.scenes = {"simple"};
    std::vector<std::string> expected = standardScenes();
    expected.emplace_back("moving-caster");
    const std::vector<Mutant> mutants = onTheGatesScenes({example(), withOwn}, watchlist);
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
}

TEST(Mutants, TheCopyHoldsEveryFolderThatTheProgramIsBuiltFrom) {
    std::istringstream layers(readFile(root / "cmake/layers.txt"));
    std::size_t folders = 0;
    for (std::string line; std::getline(layers, line);) {
        if (line.starts_with('#')) continue;
        const std::string top = line.substr(0, line.find_first_of("/:"));
        EXPECT_EQ(std::ranges::count(TreeCopy::parts, top), 1) << top;
        ++folders;
    }
    EXPECT_GT(folders, 20U);
}

TEST(Mutants, OnlyTheExpectedClassCounts) {
    Mutant mutant = example();
    mutant.expected = gate::Class::Leak;
    const Record base = test::hardRecord();
    Record head = base;
    EXPECT_FALSE(outcomeOf(mutant, {base}, {head}).caught());
    head.values["accuracy.false_shadow"] = 0.5;
    const Outcome elsewhere = outcomeOf(mutant, {base}, {head});
    EXPECT_TRUE(elsewhere.caught());
    EXPECT_FALSE(elsewhere.caughtInClass());
    head.values["accuracy.leak"] = 0.01;
    const Outcome caught = outcomeOf(mutant, {base}, {head});
    EXPECT_TRUE(caught.caughtInClass());
    EXPECT_EQ(strongest(caught)->metric, "accuracy.leak"); // though false shadow grew more
}

TEST(Mutants, TheReportCountsSharesAndNamesSurvivorsWithTheirReason) {
    Mutant leak = example(), survivor = example(), slow = example();
    leak.expected = gate::Class::Leak;
    survivor.id = "survivor";
    survivor.survives = "equal to the bit";
    slow.expected = gate::Class::Instructions;
    const Record base = test::hardRecord();
    Record leaking = base;
    leaking.values["accuracy.leak"] = 0.01;
    const Record counted = test::softRecord();
    Record slower = counted;
    slower.values["cost.instructions"] = *counted.values["cost.instructions"] * 103 / 100;
    const std::string report = mutantsReport(
        {outcomeOf(leak, {base}, {leaking}), outcomeOf(survivor, {base}, {base}), outcomeOf(slow, {counted}, {slower})},
        "commit c0ffee");
    EXPECT_NE(report.find("in 1 techniques: 1 of 2 (50 %) caught in the class"), std::string::npos) << report;
    EXPECT_NE(report.find("Slowdowns: 1 of 1 (100 %) caught by instructions; of 1 % or more, 1 of 1"), std::string::npos)
        << report;
    EXPECT_NE(report.find("+3.00 %"), std::string::npos) << report;
    EXPECT_NE(report.find("**survivor**: equal to the bit"), std::string::npos) << report;
}

} // namespace
} // namespace shadowbench::mutants
