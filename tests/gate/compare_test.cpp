// Comparing records by hand-made ones: each class of fault is found as what it is, and nothing else is.
#include "base/error.h"
#include "gate/verdict.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::gate {
namespace {

using test::drawnAnew;
using test::hardRecord;
using test::lodRecord;
using test::softRecord;

/// What is worse in a head that draws something else.
std::vector<Change> worse(const Record& base, const Record& head) {
    std::vector<Change> changes = compare({base}, {drawnAnew(head)}).changes;
    std::erase_if(changes, [](const Change& c) { return c.direction != Direction::Worse; });
    return changes;
}

/// The one class in which `head` is worse.
Class onlyWorseClass(const Record& base, const Record& head) {
    const std::vector<Change> changes = worse(base, head);
    EXPECT_FALSE(changes.empty());
    for (const Change& change : changes) EXPECT_EQ(change.changeClass, changes.front().changeClass) << change.sentence;
    return changes.empty() ? Class::Status : changes.front().changeClass;
}

TEST(Compare, EqualRecordsAreTheSame) {
    const std::vector<Change> changes = compare({hardRecord(), softRecord()}, {hardRecord(), softRecord()}).changes;
    EXPECT_GE(changes.size(), 12U);
    for (const Change& change : changes) EXPECT_EQ(change.direction, Direction::Same) << change.sentence;
    EXPECT_EQ(verdictOf(changes), ExitCode::Pass);
}

TEST(Compare, ClassesAreNeverMerged) {
    const Record base = hardRecord();
    Record head = base;
    head.values["accuracy.false_shadow"] = 0.0006; // 6.5 pixels more
    EXPECT_EQ(onlyWorseClass(base, head), Class::FalseShadow);

    head = base;
    head.values["accuracy.leak"] = 0.0008;         // 4 of the shadowed pixels more
    head.values["accuracy.false_shadow"] = 0.0001; // better by more than the leak is worse
    EXPECT_EQ(onlyWorseClass(base, head), Class::Leak);

    head = base;
    head.values["accuracy.edge_error.signed"] = -0.2;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Edge);

    head = base;
    head.values["stability.flicker.mean"] = 0.0012;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Flicker);
}

TEST(Compare, TwoPixelsOfTheirClassMeanNothingThreeDo) {
    Record base = hardRecord(); // 10,000 of its pixels are in shadow
    const auto leaks = [&](double pixels, double all) {
        Record head = base;
        head.values["accuracy.leak"] = *base.values["accuracy.leak"] + pixels / all;
        return !worse(base, head).empty();
    };
    EXPECT_FALSE(leaks(2, 10000));
    EXPECT_TRUE(leaks(3, 10000));
    base.values["accuracy.pixels.shadowed"].reset(); // of a record that does not say
    EXPECT_FALSE(leaks(2, 256 * 256));
    EXPECT_TRUE(leaks(3, 256 * 256));
}

TEST(Compare, GradedErrorsAreComparedInUnitsOfTheTruthsOwn) {
    const Record base = softRecord(); // rmse 0.031, σ 0.0006: √(0.031² + 0.0006²) − 0.031 = 5.8e-6
    Record head = base;
    head.values["accuracy.rmse"] = 0.031 + 5e-6;
    EXPECT_TRUE(worse(base, head).empty());
    head.values["accuracy.rmse"] = 0.031 + 7e-6;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Penumbra);
}

TEST(Compare, LevelsOfDetailAreCompared) {
    const Record base = lodRecord(); // its walk pops less than lod-full: −0.0002
    EXPECT_TRUE(worse(base, base).empty());
    Record head = base;
    head.values["lod.pop"] = 0.0012;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Flicker);

    head = base;
    head.values["lod.walk_pop"] = -0.0002 + 2.0 / (256 * 256); // two pixels from black to white
    EXPECT_TRUE(worse(base, head).empty());
    head.values["lod.walk_pop"] = -0.0002 + 3.0 / (256 * 256);
    EXPECT_EQ(onlyWorseClass(base, head), Class::Flicker);

    head = base;
    head.values["lod.colour_error"] = 0.065;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Colour);

    head = base;
    head.values["lod.noise"] = -0.0029; // nearer to 0 from below is worse, too
    EXPECT_EQ(onlyWorseClass(base, head), Class::Colour);
}

TEST(Compare, HalfAPerCentOfInstructionsIsTheLimit) {
    const Record base = softRecord();
    Record head = base;
    head.values["cost.instructions"] = 310442871 + 1552214; // 0.5 %
    EXPECT_TRUE(worse(base, head).empty());
    head.values["cost.instructions"] = 310442871 + 1552300;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Instructions);
    EXPECT_EQ(verdictOf(compare({base}, {head}).changes), ExitCode::CostRegression) << "images are no matter of costs";
    head = drawnAnew(head);
    head.values["accuracy.rmse"] = 0.04;
    EXPECT_EQ(verdictOf(compare({base}, {head}).changes), ExitCode::AccuracyRegression);
}

/// What could not be judged.
std::vector<Change> notCompared(const Record& base, const Record& head) {
    std::vector<Change> changes = compare({base}, {drawnAnew(head)}).changes;
    std::erase_if(changes, [](const Change& c) { return c.direction != Direction::NotCompared; });
    return changes;
}

TEST(Compare, AMetricThatTheHeadLacksIsNotJudged) {
    Record head = hardRecord();
    test::clear(head, "stability.flicker");
    ASSERT_EQ(notCompared(hardRecord(), head).size(), 1U) << "the mean, whose class it is";
    EXPECT_EQ(notCompared(hardRecord(), head)[0].changeClass, Class::Flicker);
    EXPECT_TRUE(notCompared(head, hardRecord()).empty()) << "a new one";
    head = hardRecord();
    head.figures.erase("tiles");
    EXPECT_EQ(notCompared(hardRecord(), head).size(), 1U);
}

TEST(Compare, NoGhostIsTheBestHalfLife) {
    Record with = hardRecord();
    with.values["stability.ghost_half_life"] = 3;
    EXPECT_TRUE(worse(with, hardRecord()).empty());
    EXPECT_TRUE(notCompared(with, hardRecord()).empty());
    EXPECT_EQ(onlyWorseClass(hardRecord(), with), Class::Flicker);
    Record withoutMotion = hardRecord();
    test::clear(withoutMotion, "stability");
    withoutMotion.values["accuracy.leak"] = 0; // does not matter
    EXPECT_EQ(std::ranges::count(compare({with}, {withoutMotion}).changes, "stability.ghost_half_life", &Change::metric), 1)
        << "nobody measured whether there is one";
}

TEST(Compare, AnErrorThatIsRestlessAtTheEndConvergesAfterIt) {
    Record steady = hardRecord();
    steady.values.list("stability.by_frame.changed").assign(60, 0);
    steady.values["stability.convergence"] = 50;
    Record restless = steady;
    restless.values["stability.convergence"].reset();
    EXPECT_EQ(onlyWorseClass(steady, restless), Class::Flicker);
    EXPECT_TRUE(notCompared(restless, steady).empty());
    EXPECT_TRUE(worse(restless, steady).empty());
    steady.values["stability.convergence"] = 59;
    EXPECT_TRUE(worse(steady, restless).empty()) << "frame 61 of 60 is within a frame and 5 %";
    restless.values.list("stability.by_frame.changed").clear();
    EXPECT_EQ(notCompared(steady, restless).size(), 1U) << "nobody measured when";
}

TEST(Compare, WhatSomeSeedsOfTheBaseLackIsNotJudged) {
    std::vector<Record> base, head;
    for (int seed = 1; seed <= 3; ++seed) {
        base.push_back(hardRecord());
        base.back().seed = seed;
        head.push_back(drawnAnew(base.back()));
    }
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Pass);
    test::clear(base[1], "accuracy.edge_error");
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Inconclusive);
}

TEST(Compare, InstructionsAreCountedWithOneSeedAndComparedOfIt) {
    std::vector<Record> base, head;
    for (int seed = 1; seed <= 3; ++seed) {
        base.push_back(softRecord());
        base.back().seed = seed;
        if (seed > 1) base.back().values["cost.instructions"].reset();
        head.push_back(drawnAnew(base.back()));
    }
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Pass);
    head[0].values["cost.instructions"].reset();
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Inconclusive);
    head[0].values["cost.instructions"] = 1.1 * *base[0].values["cost.instructions"];
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::CostRegression);
}

TEST(Compare, TwoPixelsBesideAnEdgeOfAThousandMayBeMissing) {
    Record base = hardRecord(), head = base;
    base.values["accuracy.edge_error.missing"] = 0.01;
    head.values["accuracy.edge_error.missing"] = 0.0119;
    EXPECT_TRUE(worse(base, head).empty());
    head.values["accuracy.edge_error.missing"] = 0.0121;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Edge);
}

TEST(Compare, InstructionsCountedInDifferentEnvironmentsAreNotJudgedScoresAre) {
    for (const auto& change : std::vector<std::function<void(Environment&)>>{
             [](Environment& e) { e.valgrind = "3.20.0"; }, [](Environment& e) { e.cpu = "another"; },
             [](Environment& e) { e.cpuFeatures = "family 26"; }, [](Environment& e) { e.libraries = "libc 2.40"; }}) {
        Record head = softRecord();
        change(head.environment);
        head.values["accuracy.rmse"] = 0.04;
        ASSERT_EQ(notCompared(softRecord(), head).size(), 1U);
        EXPECT_EQ(notCompared(softRecord(), head)[0].metric, "cost.instructions");
        EXPECT_EQ(onlyWorseClass(softRecord(), head), Class::Penumbra);
    }
}

TEST(Compare, ScoresOfWhatIsNotComparableAreNotJudged) {
    for (const auto& change : std::vector<std::function<void(Record&)>>{
             [](Record& r) { r.reference->key = "other"; }, [](Record& r) { r.reference->content = "other"; },
             [](Record& r) { r.parameters[1].second = "2048"; }, [](Record& r) { r.frames = 12; },
             [](Record& r) { r.environment.renderer = "softpipe"; }, [](Record& r) { r.environment.platform = "egl"; },
             [](Record& r) { r.environment.driver = "Mesa 23.0.0"; },
             [](Record& r) { r.environment.mesa = "libosmesa6 22.3.6-2"; }}) {
        Record head = hardRecord();
        change(head);
        EXPECT_TRUE(worse(hardRecord(), head).empty());
        ASSERT_EQ(notCompared(hardRecord(), head).size(), 1U);
        EXPECT_EQ(verdictOf(compare({hardRecord()}, {head}).changes), ExitCode::Inconclusive);
        EXPECT_NE(notCompared(hardRecord(), head)[0].sentence.find("cannot be compared: "), std::string::npos);
    }
    Record older = hardRecord(); // which does not say
    older.environment.mesa.clear();
    older.environment.libraries.clear();
    older.environment.platform = older.environment.vendor = older.environment.driver = "";
    EXPECT_EQ(verdictOf(compare({older}, {hardRecord()}).changes), ExitCode::Pass);
    Record newer = hardRecord();
    newer.parameters.emplace_back("cascades", "4"); // a parameter that the base had not
    EXPECT_EQ(verdictOf(compare({hardRecord()}, {newer}).changes), ExitCode::Pass);
}

std::vector<Record> sweepThatBreaksAt(std::optional<double> point) {
    std::vector<Record> records;
    for (const double value : {1.0, 0.1, 0.01}) { // from harmless to hard: downwards
        Record record = hardRecord();
        record.sweep = SweepStep{"near-plane", "m", "sm-psm", value, point};
        records.push_back(record);
    }
    return records;
}

TEST(Compare, ABreakPointThatComesEarlierAlongItsAxisIsWorse) {
    const auto verdict = [](std::optional<double> base, std::optional<double> head) {
        return verdictOf(compare(sweepThatBreaksAt(base), sweepThatBreaksAt(head)).changes);
    };
    EXPECT_EQ(verdict(0.01, 0.1), ExitCode::AccuracyRegression);
    EXPECT_EQ(verdict({}, 0.01), ExitCode::AccuracyRegression);
    EXPECT_EQ(verdict(0.1, 0.01), ExitCode::Pass);
    EXPECT_EQ(verdict(0.1, 0.1), ExitCode::Pass);
    EXPECT_EQ(verdict(0.1, {}), ExitCode::Pass);
}

TEST(Compare, SaysWhereACurveBreaksAndLeavesOutWhatIsNewOrHasOtherValues) {
    const auto sentences = [](const std::vector<Record>& base, const std::vector<Record>& head) {
        std::vector<std::string> said;
        for (const Change& change : compare(base, head).changes)
            if (change.changeClass == Class::BreakPoint) said.push_back(change.sentence);
        return said;
    };
    EXPECT_EQ(
        sentences(sweepThatBreaksAt({}), sweepThatBreaksAt(0.1)),
        std::vector<std::string>{"sm-psm on dueling-frusta along near-plane: it breaks at 0.1 m, before it does not break"});
    EXPECT_TRUE(sentences({}, sweepThatBreaksAt(0.1)).empty()) << "new";
    EXPECT_TRUE(sentences(sweepThatBreaksAt(0.1), {}).empty()) << "gone: its cells are";
    std::vector<Record> fewer = sweepThatBreaksAt(0.1);
    fewer.pop_back();
    EXPECT_TRUE(sentences(fewer, sweepThatBreaksAt(0.1)).empty()) << "another range";
    std::vector<Record> without = sweepThatBreaksAt(0.1);
    for (Record& record : without) record.tolerances.clear();
    ASSERT_EQ(sentences(without, sweepThatBreaksAt(0.1)).size(), 1U);
    EXPECT_NE(sentences(without, sweepThatBreaksAt(0.1))[0].find("tolerance is mismatch ≤ 0.005 and was none"),
              std::string::npos);
}

TEST(Compare, ANumberThatWas0ChangesByNoPercentage) {
    Record base = hardRecord(), head = hardRecord();
    base.values["accuracy.leak"] = 0;
    const std::vector<Change> changes = worse(base, head);
    ASSERT_EQ(changes.size(), 1U);
    EXPECT_EQ(changes[0].sentence, "sm-history:base=lispsm on dueling-frusta: accuracy.leak 0 → 0.0004");
}

TEST(Compare, ASentenceHasThreeDigitsOrAsManyAsShowTheChangeAndThePercentage) {
    const auto sentence = [](double before, double now) {
        Record base = hardRecord(), head = hardRecord();
        base.values["accuracy.leak"] = before;
        head.values["accuracy.leak"] = now;
        const std::vector<Change> changes = worse(base, head);
        return changes.empty() ? "" : changes.front().sentence.substr(changes.front().sentence.find("leak "));
    };
    EXPECT_EQ(sentence(0.0123456, 0.0223456), "leak 0.0123 → 0.0223 (+81 %)");
    EXPECT_EQ(sentence(0.2, 0.3), "leak 0.2 → 0.3 (+50 %)");
    EXPECT_EQ(sentence(0.002, 0.4), "leak 0.002 → 0.4 (× 200)");
    EXPECT_EQ(sentence(0.91151, 0.91249), "leak 0.9115 → 0.9125 (+0.108 %)");
}

TEST(Presence, WhatTheHeadLacksIsGoneOnce) {
    const Record base = hardRecord();
    const Comparison found =
        compare({base, softRecord()}, {softRecord()}, ownRules(), {{{base.scene, base.variant, false}}});
    EXPECT_EQ(text(found.presence), "1 of 2 expected results compared; gone: sm-history:base=lispsm on dueling-frusta");
}

TEST(Compare, MeaninglessIsDecidedByProgramsAndByWhatIsInBoth) {
    Record external = hardRecord(), unknown = hardRecord(), other = hardRecord();
    external.technique = external.variant = "external:engine";
    EXPECT_FALSE(whyMeaningless({external}, {external}, false)) << "its next version may be what is compared";
    unknown.dirty = true;
    unknown.program = "";
    EXPECT_FALSE(whyMeaningless({unknown}, {unknown}, false)) << "two trees with changes";
    other.commit = "decaf";
    EXPECT_FALSE(whyMeaningless({hardRecord(), other}, {hardRecord(), other}, false)) << "joined from several";
    unknown.program = "9a55";
    EXPECT_TRUE(whyMeaningless({unknown}, {unknown}, false)) << "one tree with changes";
    EXPECT_TRUE(whyMeaningless({test::unscored(Status::Error, "x")}, {hardRecord()}, true)) << "scored on one side";
    EXPECT_TRUE(whyMeaningless({}, {hardRecord()}, false));
    EXPECT_TRUE(sameProgram({hardRecord()}, {other})) << "of two commits";
    unknown.program = "";
    EXPECT_FALSE(sameProgram({unknown}, {unknown})) << "nobody knows";
    EXPECT_FALSE(sameProgram({}, {}));
}

TEST(Verdict, JUnitNamesTheFailureAndEscapesWhatXmlWouldMistake) {
    Record base = hardRecord();
    base.variant = "sm<&\">";
    Record head = base;
    head.values["accuracy.leak"] = 0.1;
    const std::string xml = junit(compare({base}, {drawnAnew(head)}).changes);
    EXPECT_NE(xml.find("<testsuite name=\"dueling-frusta\" tests=\"7\" failures=\"1\" errors=\"0\" skipped=\"0\">"),
              std::string::npos)
        << xml;
    EXPECT_NE(xml.find("name=\"sm&lt;&amp;&quot;&gt;: leak\"><failure message=\"leak is worse\">"), std::string::npos)
        << xml;
}

TEST(Verdict, AnnotationsAreOneLineForEachThingThatIsWorse) {
    Record head = hardRecord();
    head.values["accuracy.leak"] = 0.1;
    head.values["accuracy.false_shadow"] = 0.1;
    const std::string lines = annotations(compare({hardRecord()}, {drawnAnew(head)}).changes);
    EXPECT_EQ(std::ranges::count(lines, '\n'), 2);
    EXPECT_TRUE(lines.starts_with("::error title="));
}

TEST(Compare, AgainstAnExactTruthTwoPixelsOnAnEdgeMeanNothing) {
    Record base = hardRecord(), head = base; // a filtered technique's, σ = 0; of 256² pixels two are 3.1e-5
    base.values["accuracy.rmse"] = 0.1;
    base.values["accuracy.umbra_leak"] = 1.4e-11;
    head.values["accuracy.rmse"] = 0.1 + 1e-4; // √(0.1² + 3.1e-5) − 0.1 = 1.5e-4
    head.values["accuracy.umbra_leak"] = 1.7e-11;
    EXPECT_TRUE(worse(base, head).empty());
    head.values["accuracy.rmse"] = 0.1 + 2e-4;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Penumbra);
    head.values["accuracy.rmse"] = 0.1;
    head.values["accuracy.umbra_leak"] = 5e-5;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Leak);
}

TEST(Compare, AnEdgeMovedByLessThanTwoPixelsInAThousandStays) {
    Record base = hardRecord(), head = base;
    base.values["accuracy.edge_error.signed"] = 0.0002;
    head.values["accuracy.edge_error.signed"] = 0.0021;
    EXPECT_TRUE(worse(base, head).empty());
    head.values["accuracy.edge_error.signed"] = -0.0030;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Edge);
}

TEST(Compare, ASignThatTurnsWithinTheAllowanceIsTheSame) {
    Record base = hardRecord(), head = hardRecord();
    base.values["accuracy.edge_error.signed"] = 0.001;
    head.values["accuracy.edge_error.signed"] = -0.0015;
    EXPECT_TRUE(worse(base, head).empty());
    head.values["accuracy.edge_error.signed"] = -0.5;
    EXPECT_EQ(onlyWorseClass(base, head), Class::Edge);
}

TEST(Compare, MetricsThatScoreOneImageAlikeAndAnotherUnlikeJudgeNothing) {
    std::vector<Record> base, head;
    for (const char* variant : {"alike", "unlike", "other images"}) {
        base.push_back(hardRecord());
        base.back().variant = variant;
        head.push_back(base.back());
        head.back().metricCode = "another";
    }
    head[1].values["accuracy.leak"] = 0.0005;
    head[1].values["aliasing.median"].reset(); // is not compared
    head[2].images = "2222";
    for (const Change& change : compare(base, head).changes)
        EXPECT_EQ(change.direction == Direction::NotCompared, change.metric == "accuracy.leak" && change.variant != "alike")
            << change.sentence;
}

TEST(Compare, AScoreThatTheBaseWasMadeWithoutIsNoChange) {
    Record base = softRecord();
    base.values["accuracy.z_correctness"].reset(); // a score, and a judged one, that are younger than the record
    base.values["accuracy.bad30"].reset();
    EXPECT_TRUE(worse(base, softRecord()).empty());
}

} // namespace
} // namespace shadowbench::gate
