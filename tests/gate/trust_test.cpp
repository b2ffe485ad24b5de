// What an audit of the gate found, replayed on records: what once passed and must not, and what once failed and must pass.
#include "gate/verdict.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>

namespace shadowbench::gate {
namespace {

using test::hardRecord;
using test::softRecord;

/// A hard technique on an area light: labels by an exact truth, graded visibility by a soft one.
Record hardOnAreaLight() {
    Record record = hardRecord();
    record.softReference = ReferenceInfo{"povray", "beef", 1024, 0.02, {}};
    record.values["accuracy.rmse"] = 0.2;
    record.values["accuracy.pixels.graded"] = 60000;
    record.values["accuracy.pixels.penumbra"] = 600;
    return record;
}

/// On a head that draws something else.
ExitCode verdict(const Record& base, const Record& head) {
    return verdictOf(compare({base}, {test::drawnAnew(head)}).changes);
}

Record times(Record record, const char* path, double factor) {
    const metrics::Metric& metric = *metrics::metricAt(path);
    record.values[metric] = *record.values[metric] * factor;
    return record;
}

TEST(FalseGreens, EveryScoreIsCompared) {
    for (const auto& [metric, factor] : std::vector<std::pair<const char*, double>>{{"accuracy.ssim", 0.5},
                                                                                    {"accuracy.bad8", 3},
                                                                                    {"accuracy.mae", 2},
                                                                                    {"accuracy.penumbra_width_error", 4},
                                                                                    {"accuracy.umbra_leak", 3},
                                                                                    {"stability.disocclusion_error", 2},
                                                                                    {"stability.moving_rmse", 2}})
        EXPECT_EQ(verdict(softRecord(), times(softRecord(), metric, factor)), ExitCode::AccuracyRegression) << metric;
    EXPECT_EQ(verdict(hardRecord(), times(hardRecord(), "accuracy.edge_error.p95", 5)), ExitCode::AccuracyRegression);
    EXPECT_EQ(verdict(hardRecord(), times(hardRecord(), "accuracy.edge_error.signed", -1)), ExitCode::AccuracyRegression);
}

TEST(Sentences, OfAScoreWhoseBestIsOneNameItsOwnValue) {
    Record base = softRecord();
    base.values["accuracy.ssim"] = 0.8;
    const std::vector<Change> changes = compare({base}, {test::drawnAnew(times(base, "accuracy.ssim", 0.75))}).changes;
    const auto change = std::ranges::find(changes, "accuracy.ssim", &Change::metric);
    ASSERT_NE(change, changes.end());
    EXPECT_EQ(change->direction, Direction::Worse);
    EXPECT_DOUBLE_EQ(*change->base, 0.8);
    EXPECT_DOUBLE_EQ(*change->head, 0.6);
    EXPECT_NE(change->sentence.find("accuracy.ssim 0.8 → 0.6 (-25 %)"), std::string::npos) << change->sentence;
}

TEST(FalseGreens, WorkAndFiguresAreCompared) {
    for (const char* metric :
         std::vector<const char*>{"cost.work.fragments", "cost.work.draws", "cost.work.passes", "cost.work.bytes"})
        EXPECT_EQ(verdict(hardRecord(), times(hardRecord(), metric, 10)), ExitCode::CostRegression);
    Record head = hardRecord();
    head.figures["tiles"] = 60;
    EXPECT_EQ(verdict(hardRecord(), head), ExitCode::AccuracyRegression);
    head.figures.erase("tiles");
    EXPECT_EQ(verdict(hardRecord(), head), ExitCode::Inconclusive);
}

TEST(FalseGreens, TheSignOfAnEdgesErrorMayTurnOnlyWhereItShrinks) {
    EXPECT_EQ(verdict(hardRecord(), times(hardRecord(), "accuracy.edge_error.signed", -0.5)), ExitCode::Pass);
    EXPECT_EQ(verdict(hardRecord(), times(hardRecord(), "accuracy.edge_error.signed", -1)), ExitCode::AccuracyRegression);
}

TEST(FalseGreens, ASoftTruthsUncertaintyExcusesNothingThatItDidNotJudge) {
    const Record base = hardOnAreaLight();
    EXPECT_EQ(verdict(base, times(base, "stability.moving_rmse", 1.2)), ExitCode::AccuracyRegression);
    EXPECT_EQ(verdict(base, times(base, "stability.flicker.mean", 1.2)), ExitCode::AccuracyRegression);
    // Of rmse, over all pixels, only those of the penumbra are uncertain: √(0.2² + 0.02² · 0.01) − 0.2 = 1e-5.
    Record head = base;
    head.values["accuracy.rmse"] = 0.2 + 0.8e-5;
    EXPECT_EQ(verdict(base, head), ExitCode::Pass);
    head.values["accuracy.rmse"] = 0.2 + 1.2e-5;
    EXPECT_EQ(verdict(base, head), ExitCode::AccuracyRegression);
}

/// The same records, made by a program whose code of metrics differs.
Record rescored(Record record, double factor) {
    record.metricCode = "another";
    for (const char* metric : {"accuracy.mismatch", "accuracy.leak", "accuracy.false_shadow", "stability.flicker.mean"}) {
        std::optional<double>& value = record.values[*metrics::metricAt(metric)];
        value = *value * factor;
    }
    return record;
}

TEST(FalseGreens, MetricsThatScoreTheSameImagesDifferentlyAreNoImprovement) {
    const std::vector<Change> changes = compare({hardRecord()}, {rescored(hardRecord(), 0.5)}).changes;
    EXPECT_EQ(verdictOf(changes), ExitCode::Inconclusive);
    EXPECT_EQ(std::ranges::count(changes, Direction::Better, &Change::direction), 0);
    EXPECT_EQ(std::ranges::count(changes, Direction::NotCompared, &Change::direction), 4) << "each is listed";
}

TEST(FalseGreens, MetricsThatScoreTheSameImagesAlikeAreTheSameCode) {
    Record other = hardRecord(), changed = hardRecord();
    other.variant = changed.variant = "sm-uniform";
    changed.images = "2222";
    EXPECT_EQ(verdictOf(compare({hardRecord(), other}, {rescored(hardRecord(), 1), rescored(changed, 1)}).changes),
              ExitCode::Pass);
    EXPECT_EQ(verdictOf(compare({hardRecord(), other}, {rescored(hardRecord(), 1), rescored(changed, 2)}).changes),
              ExitCode::AccuracyRegression);
    EXPECT_EQ(verdictOf(compare({other}, {rescored(changed, 1)}).changes), ExitCode::Inconclusive) << "no image is the same";
    EXPECT_EQ(verdictOf(compare({hardRecord(), other}, {rescored(hardRecord(), 2), rescored(changed, 1)}).changes),
              ExitCode::Inconclusive);
}

/// A hard row whose flicker and pixel areas were scored against a truth of pixel areas.
Record againstAreas(const std::string& key, const std::string& content) {
    Record record = hardRecord();
    record.pixelReference = ReferenceInfo{"pixel-areas", key, 0, 0, {}, content};
    record.values["accuracy.pixel_area.rmse"] = 0.05;
    return record;
}

std::set<std::string> metricsNotCompared(const std::vector<Change>& changes) {
    std::set<std::string> metrics;
    for (const Change& change : changes)
        if (change.direction == Direction::NotCompared) metrics.insert(change.metric);
    return metrics;
}

TEST(FalseGreens, WhatAnotherTruthOfPixelAreasJudgedIsNotCompared) {
    const Record base = againstAreas("c0de", "aaaa");
    const std::set<std::string> byAreas{"accuracy.pixel_area.rmse", "stability.flicker.mean"};
    for (Record head : {againstAreas("other", "aaaa"), againstAreas("c0de", "bbbb")}) {
        head.values["stability.flicker.mean"] = 0.0005;
        EXPECT_EQ(metricsNotCompared(compare({base}, {head}).changes), byAreas);
        EXPECT_EQ(verdict(base, head), ExitCode::Inconclusive);
        head.values["accuracy.leak"] = 0.1;
        const std::vector<Change> changes = compare({base}, {test::drawnAnew(head)}).changes;
        EXPECT_EQ(std::ranges::count(changes, Direction::Worse, &Change::direction), 1) << "labels have their own truth";
    }
    Record older = hardRecord(); // its flicker was measured against labels
    EXPECT_EQ(metricsNotCompared(compare({older}, {base}).changes), std::set<std::string>{"stability.flicker.mean"});
    EXPECT_EQ(verdict(base, againstAreas("c0de", "aaaa")), ExitCode::Pass);
    EXPECT_EQ(verdict(base, againstAreas("c0de", "")), ExitCode::Pass) << "older records do not say";
}

TEST(FalseGreens, WhatAnotherSoftTruthJudgedIsNotCompared) {
    const Record base = hardOnAreaLight();
    Record head = base;
    head.softReference->key = "other";
    head.values["accuracy.rmse"] = 0.1;
    EXPECT_EQ(metricsNotCompared(compare({base}, {head}).changes), std::set<std::string>{"accuracy.rmse"});
    head.values["accuracy.leak"] = 0.1;
    EXPECT_EQ(verdict(base, head), ExitCode::Inconclusive) << "before what is worse";
}

TEST(FalseGreens, ImagesScoredByAnotherTruthSayNothingOfMetricsCode) {
    std::vector<Record> base, head;
    for (const char* variant : {"other-truth", "same-images", "other-images"}) {
        base.push_back(againstAreas("c0de", "aaaa"));
        base.back().variant = variant;
        head.push_back(base.back());
        head.back().metricCode = "another";
    }
    head[0].pixelReference->key = "other";
    head[0].values["stability.flicker.mean"] = 0.0005;
    head[2].images = "2222";
    EXPECT_EQ(metricsNotCompared(compare({base[1], base[2]}, {head[1], head[2]}).changes), std::set<std::string>());
    for (const Change& change : compare(base, head).changes)
        EXPECT_EQ(change.direction == Direction::NotCompared,
                  change.variant == "other-truth" &&
                      (change.metric == "stability.flicker.mean" || change.metric == "accuracy.pixel_area.rmse"))
            << change.sentence;
}

TEST(FalseGreens, AWiderToleranceMovesNoBreakPoint) {
    std::vector<Record> base, head;
    for (const double value : {1.0, 0.1, 0.01}) {
        Record record = hardRecord();
        record.sweep = SweepStep{"near-plane", "m", "sm-psm", value, 0.1};
        base.push_back(record);
        record.sweep->breakPoint.reset();
        record.tolerances["mismatch"] = 0.05;
        head.push_back(record);
    }
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Inconclusive);
}

TEST(FalseGreens, OneProgramTwiceAndNothingInBothDecideNothing) {
    Record other = hardRecord();
    other.commit = "decaf";
    EXPECT_TRUE(whyMeaningless({hardRecord()}, {hardRecord()}, false));
    EXPECT_FALSE(whyMeaningless({hardRecord()}, {hardRecord()}, true));
    EXPECT_FALSE(whyMeaningless({hardRecord()}, {other}, false));
    EXPECT_TRUE(sameProgram({hardRecord()}, {other}));
    Record changed = hardRecord();
    changed.dirty = true;
    changed.program = "other";
    EXPECT_FALSE(whyMeaningless({hardRecord()}, {changed}, false)) << "the commit, and a tree with changes";
    EXPECT_FALSE(sameProgram({hardRecord()}, {changed}));
    EXPECT_TRUE(whyMeaningless({hardRecord()}, {softRecord()}, true));
    EXPECT_TRUE(whyMeaningless({hardRecord()}, {}, true));
    EXPECT_TRUE(whyMeaningless({other}, {test::unscored(Status::Error, "it failed")}, true));
}

TEST(FalseGreens, JUnitShowsWhatCouldNotBeJudged) {
    Record head = hardRecord();
    head.reference->key = "other";
    const std::string xml = junit(compare({hardRecord()}, {head}).changes, {"a technique no longer exists"});
    EXPECT_NE(xml.find("failures=\"0\" errors=\"1\" skipped=\"0\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("<error message=\"status is not compared\">"), std::string::npos) << xml;
    EXPECT_NE(xml.find("<testsuite name=\"gate\""), std::string::npos) << xml;
    const Change unclear{"trees", "pcf", "time.ratio", Class::Time, 1, 1.02, 0.01, Direction::Unclear, "perhaps slower"};
    EXPECT_NE(junit({unclear}).find("<skipped message=\"time is unclear\">perhaps slower"), std::string::npos);
    EXPECT_EQ(verdictOf({unclear}), ExitCode::Pass);
}

TEST(FalseReds, OneMoreLeakedPixelIsNoRegression) {
    Record head = hardRecord();
    head.values["accuracy.leak"] = *head.values["accuracy.leak"] + 1.0 / 10000;
    EXPECT_EQ(verdict(hardRecord(), head), ExitCode::Pass);
}

TEST(FalseReds, AChangedSceneHidesNoOtherCell) {
    Record changed = softRecord(), slower = hardRecord();
    changed.reference->key = "other";
    slower.values["accuracy.leak"] = 0.1;
    const std::vector<Change> changes = compare({softRecord(), hardRecord()}, {changed, test::drawnAnew(slower)}).changes;
    EXPECT_EQ(std::ranges::count(changes, Direction::NotCompared, &Change::direction), 1);
    EXPECT_EQ(std::ranges::count(changes, Direction::Worse, &Change::direction), 1);
}

TEST(FalseReds, AHistoryMayConvergeAFrameLater) {
    const auto after = [](double frames) {
        Record head = hardRecord();
        head.values["stability.convergence"] = *head.values["stability.convergence"] + frames;
        return verdict(hardRecord(), head);
    };
    EXPECT_EQ(after(1), ExitCode::Pass);
    EXPECT_EQ(after(4), ExitCode::AccuracyRegression);
}

/// Eight seeds of a stochastic technique whose leak is `leak` and varies by some pixels.
std::vector<Record> seeds(double leak, double shift) {
    std::vector<Record> records;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        Record record = hardRecord();
        record.seed = seed;
        if (shift != 0) record.images = "2222";
        record.values["accuracy.leak"] = leak + 0.001 * ((seed + shift) * 5 / 8 - std::floor((seed + shift) * 5 / 8));
        records.push_back(record);
    }
    return records;
}

TEST(FalseReds, AnotherChoiceOfPseudoRandomNumbersIsNoRegression) {
    EXPECT_NE(verdict(seeds(0.01, 0)[0], seeds(0.01, 0.5)[3]), ExitCode::Pass) << "which one seed would say";
    EXPECT_EQ(verdictOf(compare(seeds(0.01, 0), seeds(0.01, 0.5)).changes), ExitCode::Pass);
    EXPECT_EQ(verdictOf(compare(seeds(0.01, 0), seeds(0.013, 0.5)).changes), ExitCode::AccuracyRegression);
}

/// A technique whose seeds differ by chance does not fail with some of them.
TEST(FalseGreens, SeedsExcuseNoCatastrophe) {
    for (const int failing : {1, 2, 4, 6, 8}) {
        std::vector<Record> head = seeds(0.01, 0.5);
        for (int i = 0; i < failing; ++i) head[static_cast<std::size_t>(i)].values["accuracy.leak"] = 1;
        EXPECT_EQ(verdictOf(compare(seeds(0.01, 0), head).changes), ExitCode::AccuracyRegression) << failing;
    }
}

TEST(FalseReds, TheSignOfAMeanOverSeedsCountsNotThatOfTheFirst) {
    std::vector<Record> base = seeds(0.01, 0), head = seeds(0.01, 0.5);
    for (std::size_t i = 0; i < base.size(); ++i) {
        base[i].values["accuracy.edge_error.signed"] = i == 0 ? 0.1 : -0.1;
        head[i].values["accuracy.edge_error.signed"] = i == 1 ? 0.1 : -0.1;
    }
    EXPECT_EQ(verdictOf(compare(base, head).changes), ExitCode::Pass);
}

// --- what is there, and who made it --------------------------------------------------------------------------------------

Direction statusOf(const std::vector<Record>& base, const std::vector<Record>& head) {
    for (const Change& change : compare(base, head).changes)
        if (change.changeClass == Class::Status) return change.direction;
    return Direction::Same;
}

TEST(FalseGreens, AbsenceIsNotTheSame) {
    const Record failed = test::unscored(Status::Error, "the shader fails"),
                 none = test::unscored(Status::NotApplicable, "needs an area light");
    EXPECT_EQ(statusOf({hardRecord()}, {failed}), Direction::NotCompared);
    EXPECT_EQ(statusOf({failed}, {hardRecord()}), Direction::NotCompared) << "no improvement";
    EXPECT_EQ(statusOf({failed}, {failed}), Direction::NotCompared);
    EXPECT_EQ(statusOf({hardRecord()}, {none}), Direction::NotCompared);
    EXPECT_EQ(statusOf({hardRecord(), softRecord()}, {hardRecord()}), Direction::NotCompared);
    EXPECT_EQ(statusOf({hardRecord()}, {hardRecord(), softRecord()}), Direction::NotCompared) << "the base is not whole";
    EXPECT_EQ(statusOf({hardRecord()}, {hardRecord(), hardRecord()}), Direction::NotCompared) << "which of the two?";
    EXPECT_EQ(statusOf({hardRecord(), hardRecord()}, {hardRecord()}), Direction::NotCompared);
    EXPECT_EQ(statusOf({none}, {none}), Direction::Same);
    EXPECT_EQ(statusOf({none}, {hardRecord()}), Direction::Same) << "new";
    EXPECT_EQ(statusOf({hardRecord()}, {test::expectedFailure()}), Direction::Same) << "it is scored";
}

TEST(FalseGreens, WhatIsExpectedMustBeThere) {
    const Record base = hardRecord();
    const auto verdict = [&](const std::vector<Record>& head, const std::vector<Expected>& expected) {
        return verdictOf(compare({base}, head, ownRules(), expected).changes);
    };
    const Expected own{base.scene, base.variant}, other{softRecord().scene, softRecord().variant},
        isNew{softRecord().scene, softRecord().variant, true};
    EXPECT_EQ(verdict({base}, {own}), ExitCode::Pass);
    EXPECT_EQ(verdict({base}, {own, other}), ExitCode::Inconclusive) << "neither side has it";
    EXPECT_EQ(verdict({base, softRecord()}, {own, other}), ExitCode::Inconclusive) << "the base knows it";
    EXPECT_EQ(verdict({base, softRecord()}, {own, isNew}), ExitCode::Pass);
    EXPECT_EQ(verdict({base}, {own, isNew}), ExitCode::Inconclusive);
}

TEST(Presence, SaysHowManyResultsWereCompared) {
    const Record failed = test::unscored(Status::Error, "the shader fails");
    Record gone = hardRecord(), another = hardRecord();
    gone.variant = "gone";
    another.variant = "another";
    EXPECT_EQ(text(compare({hardRecord(), softRecord(), gone}, {failed, softRecord(), another}).presence),
              "1 of 4 expected results compared; new: another on dueling-frusta; gone: gone on dueling-frusta; failed: "
              "sm-history:base=lispsm on dueling-frusta");
    std::vector<Record> many(8, hardRecord());
    for (std::size_t i = 0; i < many.size(); ++i) many[i].variant = std::to_string(i);
    EXPECT_TRUE(text(compare(many, {}).presence).ends_with("4 on dueling-frusta and 3 more"));
}

/// Equal images, equal truth and another score: whatever changed, it is not the technique.
TEST(FalseGreens, EqualImagesHaveEqualScores) {
    for (const double factor : {0.5, 2.0}) {
        const auto changes = compare({hardRecord()}, {times(hardRecord(), "accuracy.leak", factor)}).changes;
        EXPECT_EQ(verdictOf(changes), ExitCode::Inconclusive) << "the code has one hash";
        EXPECT_EQ(std::ranges::count(changes, Direction::NotCompared, &Change::direction), 1);
    }
    EXPECT_EQ(verdictOf(compare({hardRecord()}, {times(hardRecord(), "cost.work.fragments", 0.5)}).changes), ExitCode::Pass)
        << "less work for the same image is an improvement";
    Record map = times(hardRecord(), "aliasing.median", 0.9);
    EXPECT_EQ(verdictOf(compare({hardRecord()}, {map}).changes), ExitCode::Pass) << "of the map, not of the images";
}

TEST(FalseGreens, CodeThatCountsLessEverywhereIsNoImprovement) {
    const auto counted = [](const char* variant, double factor) {
        Record record = times(hardRecord(), "cost.work.fragments", factor);
        record.variant = variant;
        if (factor != 1) record.metricCode = "another";
        return record;
    };
    const std::vector<Record> base{counted("a", 1), counted("b", 1)};
    EXPECT_EQ(verdictOf(compare(base, {counted("a", 0.5), counted("b", 0.5)}).changes), ExitCode::Inconclusive);
    Record alike = counted("b", 1);
    alike.metricCode = "another";
    EXPECT_EQ(verdictOf(compare(base, {counted("a", 0.5), alike}).changes), ExitCode::Pass) << "the technique does less";
}

// --- whose rules judge
// -----------------------------------------------------------------------------------------------------

TEST(FalseGreens, AnAllowanceOfTheHeadAloneExcusesNothing) {
    Rules loose = ownRules();
    for (auto& [path, limit] : loose.limits) limit.absolute = limit.relative = 1e6;
    loose.seedErrors = 1e6;
    EXPECT_GT(loosened(ownRules(), loose).size(), 50U);
    EXPECT_TRUE(loosened(ownRules(), ownRules()).empty());
    const auto verdictBy = [&](const Rules& rules) {
        return verdictOf(
            compare({hardRecord()}, {test::drawnAnew(times(hardRecord(), "accuracy.leak", 100))}, rules).changes);
    };
    EXPECT_EQ(verdictBy(loose), ExitCode::Pass);
    EXPECT_EQ(verdictBy(stricter(ownRules(), loose)), ExitCode::AccuracyRegression);
    EXPECT_EQ(verdictBy(stricter(loose, ownRules())), ExitCode::AccuracyRegression);
    Rules none = ownRules();
    none.limits.erase("accuracy.leak");
    EXPECT_EQ(loosened(ownRules(), none), std::vector<std::string>{"accuracy.leak is no longer judged"});
    EXPECT_EQ(verdictBy(none), ExitCode::Pass);
    EXPECT_EQ(verdictBy(stricter(ownRules(), none)), ExitCode::AccuracyRegression);
    Rules withoutSign = ownRules();
    withoutSign.limits.find("accuracy.edge_error.signed")->second.magnitude = false;
    EXPECT_EQ(loosened(ownRules(), withoutSign).size(), 1U);
    EXPECT_TRUE(stricter(ownRules(), withoutSign).limits.find("accuracy.edge_error.signed")->second.magnitude);
    Rules exact = ownRules(); // as if the truth of a graded score had no error of its own
    Limit& graded = exact.limits.find("accuracy.rmse")->second;
    ASSERT_NE(graded.truth, metrics::TruthError::None);
    graded.truth = metrics::TruthError::None;
    for (const Rules& both : {stricter(exact, ownRules()), stricter(ownRules(), exact)})
        EXPECT_EQ(both.limits.find("accuracy.rmse")->second.truth, metrics::TruthError::None);
}

} // namespace
} // namespace shadowbench::gate
