// Series out of records, their levels and changes.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "history/changes.h"
#include "history/history_report.h"
#include "history/store.h"
#include "tests/support/message_of.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench::history {
namespace {

using test::hardRecord;
using test::softRecord;

constexpr double pixel = 1.0 / 10000; // of the shadowed ones of the example records

std::string hashOf(std::size_t index) { return std::to_string(1000000 + index) + std::string(33, 'a'); }

/// A commit for each list of records, in order.
std::vector<Commit> commitsOf(const std::vector<std::vector<Record>>& lists) {
    std::vector<Commit> commits;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        commits.push_back({hashOf(i), "2026010" + std::to_string(i + 1) + "T000000Z", lists[i]});
        for (Record& record : commits.back().records) record.commit = hashOf(i);
    }
    return commits;
}

std::vector<Commit> leaks(const std::vector<double>& values) {
    std::vector<std::vector<Record>> lists;
    for (const double value : values) {
        Record record = hardRecord();
        record.values["accuracy.leak"] = value;
        record.images = std::to_string(value); // drawn otherwise
        lists.push_back({record});
    }
    return commitsOf(lists);
}

Findings findingsOf(const std::vector<Commit>& commits, const Selection& selection = {}) {
    Findings findings;
    findings.history = historyOf(commits, selection);
    findings.subjects.assign(commits.size(), "");
    static_cast<Levels&>(findings) = levelsOf(findings.history, {});
    findings.events = eventsOf(findings.history);
    findings.changes = changesBetween(findings.history, findings.levels);
    findings.suspects = suspectsOf(findings.history, findings.changes, std::nullopt);
    return findings;
}

const Selection onlyLeak{{"accuracy.leak"}, {}, {}};

TEST(Series, HoldsAFigureACommit) {
    const History history = historyOf(leaks({0.1, 0.2, 0.2}), onlyLeak);
    ASSERT_EQ(history.series.size(), 1U);
    const Series& series = history.series[0];
    EXPECT_EQ(series.scene, "dueling-frusta");
    EXPECT_EQ(series.metric, "accuracy.leak");
    ASSERT_EQ(series.points.size(), 3U);
    EXPECT_EQ(series.points[2].commit, 2U);
    EXPECT_DOUBLE_EQ(series.points[1].value, 0.2);
    EXPECT_DOUBLE_EQ(series.points[1].allowance, 2 * pixel); // the gate's, of labels
}

TEST(Series, ASecondMeasurementOfACommitReplacesTheFirstUnlessItIsNoisy) {
    Record again = test::drawnAnew(hardRecord());
    again.values["accuracy.leak"] = 0.3;
    const History history = historyOf(commitsOf({{hardRecord(), again}}), {{"accuracy.leak", "cost.time.ratio"}, {}, {}});
    ASSERT_EQ(history.series.size(), 2U);
    ASSERT_EQ(history.series[0].points.size(), 1U);
    EXPECT_DOUBLE_EQ(history.series[0].points[0].value, 0.3);
    EXPECT_EQ(history.series[1].points.size(), 2U);
    EXPECT_TRUE(history.series[1].noisy);
}

TEST(Series, FollowsAnotherRendererFromVersionToVersion) {
    std::vector<Commit> commits = leaks({0.1, 0.2});
    for (Commit& commit : commits) {
        Record& record = commit.records[0];
        record.technique = record.variant = "external:my-engine";
        record.environment.gl = notDrawnHere;
        record.environment.renderer = "my engine of " + commit.hash;
    }
    const Findings findings = findingsOf(commits, onlyLeak);
    ASSERT_EQ(findings.history.series.size(), 1U);
    EXPECT_EQ(findings.changes.size(), 1U);
}

/// Series of one metric when the second commit's record is changed.
template <typename Change>
std::size_t seriesWhen(const std::string& metric, const Change& change) {
    Record one = softRecord();
    one.reference->content = "f00d";
    Record other = one;
    change(other);
    return historyOf(commitsOf({{one}, {other}}), {{metric}, {}, {}}).series.size();
}

TEST(Series, FiguresThatTheGateWouldNotCompareAreDifferentSeries) {
    const auto renderer = [](Record& r) { r.environment.renderer = "llvmpipe (LLVM 16)"; };
    const auto cpu = [](Record& r) { r.environment.cpu = "another"; };
    const auto valgrind = [](Record& r) { r.environment.valgrind = "3.20.0"; };
    const auto truth = [](Record& r) { r.reference->key = "another"; };
    const auto compiler = [](Record& r) { r.environment.compiler = "another"; };
    for (const char* metric : {"accuracy.rmse", "cost.instructions", "cost.time.ratio"}) {
        EXPECT_EQ(seriesWhen(metric, renderer), 2U) << metric;
        EXPECT_EQ(seriesWhen(metric, compiler), 1U) << metric; // a part of the program
    }
    EXPECT_EQ(seriesWhen("accuracy.rmse", cpu), 1U);
    EXPECT_EQ(seriesWhen("cost.instructions", cpu), 2U);
    EXPECT_EQ(seriesWhen("cost.time.ratio", cpu), 2U);
    EXPECT_EQ(seriesWhen("accuracy.rmse", valgrind), 1U);
    EXPECT_EQ(seriesWhen("cost.instructions", valgrind), 2U);
    const auto content = [](Record& r) { r.reference->content = "another"; };
    const auto parameter = [](Record& r) { r.parameters.front().second = "another"; };
    const auto frames = [](Record& r) { ++r.frames; };
    for (const char* metric : {"accuracy.rmse", "cost.instructions", "cost.time.ratio"}) {
        EXPECT_EQ(seriesWhen(metric, truth), 2U) << metric; // perhaps of another scene
        EXPECT_EQ(seriesWhen(metric, content), 2U) << metric;
        EXPECT_EQ(seriesWhen(metric, parameter), 2U) << metric;
        EXPECT_EQ(seriesWhen(metric, frames), 2U) << metric;
    }
}

TEST(Series, OtherCodeOfTheMetricsScoresAlikeWhereEqualImagesSaySo) {
    const auto code = [](Record& r) { r.metricCode = "another"; };
    const auto unlike = [](Record& r) {
        r.metricCode = "another";
        r.values["accuracy.rmse"] = 0.5 * *r.values["accuracy.rmse"];
    };
    const auto images = [](Record& r) {
        r.metricCode = "another";
        r.images = "another";
    };
    EXPECT_EQ(seriesWhen("accuracy.rmse", code), 1U);
    EXPECT_EQ(seriesWhen("accuracy.rmse", unlike), 2U) << "halved errors are no improvement";
    EXPECT_EQ(seriesWhen("accuracy.penumbra_rmse", unlike), 1U) << "another metric";
    EXPECT_EQ(seriesWhen("accuracy.rmse", images), 2U) << "no cell says that it scores alike";
    EXPECT_EQ(seriesWhen("cost.instructions", images), 1U) << "no score";
}

TEST(Series, OfTwoMachinesInTurnAreTwo) {
    Record one = hardRecord(), two = hardRecord();
    two.environment.cpu = "another";
    const History history = historyOf(commitsOf({{one, two}, {one, two}, {two}}), {{"cost.time.ratio"}, {}, {}});
    ASSERT_EQ(history.series.size(), 2U);
    EXPECT_EQ(history.series[0].points.size(), 2U);
    EXPECT_EQ(history.series[1].points.size(), 3U);
    EXPECT_NE(history.series[1].apart.find("other surroundings: cpu is \"some cpu\" and \"another\""), std::string::npos)
        << history.series[1].apart;
    EXPECT_EQ(eventsOf(history).size(), 1U) << "the first goes on in the second";
}

TEST(Series, OtherCellsAreOtherSeries) {
    Record large = hardRecord(), seeded = hardRecord(), swept = hardRecord();
    large.width = 512;
    seeded.seed = 2;
    swept.sweep = SweepStep{"near-plane", "m", "sm-history", 0.1, {}};
    EXPECT_EQ(historyOf(commitsOf({{hardRecord(), large, seeded, swept}}), onlyLeak).series.size(), 4U);
}

TEST(Series, SelectionsAreByMetricSceneAndTechnique) {
    const std::vector<Commit> commits = commitsOf({{hardRecord(), softRecord()}});
    for (const Series& series : historyOf(commits, {{"accuracy.*"}, {"over*"}, {}}).series) {
        EXPECT_TRUE(series.metric.starts_with("accuracy."));
        EXPECT_EQ(series.scene, "overlapping-occluders");
    }
    const std::size_t byId = historyOf(commits, {{}, {}, {"pcss"}}).series.size();
    EXPECT_GT(byId, 0U);
    EXPECT_EQ(historyOf(commits, {{}, {}, {"pcss:taps=*"}}).series.size(), byId);
    EXPECT_TRUE(historyOf(commits, {{}, {}, {"vsm"}}).series.empty());
}

TEST(Changes, NameTheLastCommitOnTheOldLevelAndTheFirstOnTheNew) {
    const Findings findings = findingsOf(leaks({0.1, 0.1, 0.4, 0.4}), onlyLeak);
    ASSERT_EQ(findings.changes.size(), 1U);
    const LevelChange& change = findings.changes[0];
    EXPECT_EQ(change.before.last, 1U);
    EXPECT_EQ(change.after.first, 2U);
    EXPECT_EQ(change.direction, gate::Direction::Worse);
    EXPECT_DOUBLE_EQ(change.size, 0.75); // of the larger
}

TEST(Changes, OfTwoPixelsAreNoneAndOfThreeAreSmall) {
    EXPECT_TRUE(findingsOf(leaks({0, 2 * pixel}), onlyLeak).changes.empty());
    const Findings findings = findingsOf(leaks({0, 3 * pixel}), onlyLeak);
    ASSERT_EQ(findings.changes.size(), 1U);
    EXPECT_NEAR(findings.changes[0].size, 0.015, 1e-12); // one and a half allowances
}

TEST(Changes, LargerOnesComeFirst) {
    std::vector<Commit> commits = leaks({0.1, 0.11});
    commits[1].records[0].values["accuracy.false_shadow"] = 0.5;
    const Findings findings = findingsOf(commits);
    ASSERT_EQ(findings.changes.size(), 2U);
    EXPECT_EQ(findings.history.series[findings.changes[0].series].metric, "accuracy.false_shadow");
    ASSERT_EQ(findings.suspects.size(), 1U); // of the same commit
    EXPECT_EQ(findings.suspects[0].changes.size(), 2U);
}

TEST(Series, BreaksWhereEqualImagesHaveAnotherScore) {
    std::vector<Commit> commits = leaks({0.1, 0.2});
    commits[1].records[0].images = commits[0].records[0].images;
    const Findings findings = findingsOf(commits, onlyLeak);
    EXPECT_TRUE(findings.changes.empty()) << "no technique did it";
    ASSERT_EQ(findings.history.series.size(), 2U);
    EXPECT_TRUE(findings.history.series[1].apart.starts_with("images and truth are the same"));
}

TEST(Changes, ACellThatFailsIsOne) {
    const Findings findings = findingsOf(commitsOf({{hardRecord()}, {test::unscored(Status::Error, "no shader")}}));
    ASSERT_EQ(findings.changes.size(), 1U);
    EXPECT_EQ(findings.history.series[findings.changes[0].series].metric, "status.error");
    EXPECT_EQ(findings.changes[0].direction, gate::Direction::Worse);
}

TEST(Changes, HeldForThreeCommitsOf40AreListed) {
    std::vector<double> values(40, 0.1);
    for (std::size_t i = 20; i < 23; ++i) values[i] = 0.2;
    const Findings findings = findingsOf(leaks(values), onlyLeak);
    ASSERT_EQ(findings.changes.size(), 2U);
    EXPECT_EQ(findings.changes[0].after.first, 20U);
    EXPECT_EQ(findings.changes[1].after.first, 23U);
}

TEST(Changes, OfManySmallStepsAreFound) {
    std::vector<double> values;
    for (int i = 0; i < 12; ++i) values.push_back(0.1 + 0.9 * i * pixel); // not half of what is allowed
    const Findings findings = findingsOf(leaks(values), onlyLeak);
    EXPECT_EQ(findings.changes.size(), 3U);
    for (const LevelChange& change : findings.changes) EXPECT_EQ(change.direction, gate::Direction::Worse);
}

/// "what metric commit" of each.
std::vector<std::string> said(const Findings& findings) {
    std::vector<std::string> all;
    for (const Event& event : findings.events)
        all.push_back(event.what + " " + findings.history.series[event.series].metric + " " + std::to_string(event.commit));
    return all;
}

TEST(Events, WhatVanishedAndBeganIsListed) {
    const Selection two{{"accuracy.leak", "accuracy.rmse"}, {}, {}};
    std::vector<Commit> commits = leaks({0.1, 0.1, 0.1, 0.1});
    for (Commit& commit : commits) commit.records[0].values["accuracy.rmse"].reset();
    EXPECT_TRUE(findingsOf(commits, two).events.empty());
    for (const std::size_t i : {2U, 3U}) commits[i].records[0].values["accuracy.leak"].reset();
    commits[3].records[0].values["accuracy.rmse"] = 0.1;
    const Findings findings = findingsOf(commits, two);
    EXPECT_EQ(said(findings), (std::vector<std::string>{"vanished accuracy.leak 1", "began accuracy.rmse 3"}));
    const std::string text = report(findings, "text");
    EXPECT_NE(text.find("1 began, 1 vanished, 0 broke off, 0 in error"), std::string::npos) << text;
    EXPECT_NE(report(findings, "md").find("## What began, vanished"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(report(findings, "json"))["events"][0]["what"], "vanished");
}

TEST(Events, AnotherTruthIsABreakHoweverBadTheScores) {
    std::vector<Commit> commits = leaks({0, 0, 1, 1});
    for (const std::size_t i : {2U, 3U}) commits[i].records[0].reference->key = "another";
    const Findings findings = findingsOf(commits, onlyLeak);
    EXPECT_TRUE(findings.changes.empty()) << "which cannot be told";
    ASSERT_EQ(findings.events.size(), 1U);
    EXPECT_NE(findings.events[0].what.find("scored against different truths"), std::string::npos);
    EXPECT_EQ(findings.events[0].commit, 2U);
    EXPECT_NE(report(findings, "text").find("1 broke off"), std::string::npos);
}

TEST(Events, ACellInErrorIsListedAsLongAsItIs) {
    const Record failing = test::unscored(Status::Error, "no shader");
    const Selection status{{"status.error"}, {}, {}};
    EXPECT_EQ(said(findingsOf(commitsOf({{failing}, {failing}}), status)),
              std::vector<std::string>{"in error status.error 1"});
    Record scored = hardRecord();
    scored.scene = failing.scene;
    scored.variant = failing.variant;
    EXPECT_EQ(said(findingsOf(commitsOf({{scored}, {failing}, {failing}}), status)),
              std::vector<std::string>{"in error status.error 2"});
    EXPECT_TRUE(said(findingsOf(commitsOf({{failing}, {scored}}), status)).empty());
}

/// Twenty commits, ten before and ten after a step of the cost; 1 % of noise that repeats after seven commits.
std::vector<Commit> costs(double before, double after) {
    std::vector<std::vector<Record>> lists;
    for (std::size_t i = 0; i < 20; ++i) {
        Record record = hardRecord();
        record.values["cost.time.ratio"] = (i < 10 ? before : after) * (1 + 0.01 * (static_cast<double>(i * 3 % 7) - 3) / 3);
        lists.push_back({record});
    }
    return commitsOf(lists);
}

TEST(Changes, OfTimesAreThoseThatNoiseDoesNotMake) {
    const Selection onlyTime{{"cost.time.ratio"}, {}, {}};
    EXPECT_TRUE(findingsOf(costs(1, 1), onlyTime).changes.empty());
    const Findings findings = findingsOf(costs(1, 1.1), onlyTime);
    ASSERT_EQ(findings.changes.size(), 1U);
    EXPECT_EQ(findings.changes[0].after.first, 10U);
    EXPECT_NEAR(findings.changes[0].after.value, 1.1, 0.011); // the median of the noise lies within it
    // Ten figures are left for the next change. The noise spans 2 %: a rise by less than half of that is none, by 4 % all of
    // the newest figures lie above all others.
    ASSERT_TRUE(findings.smallest[0].has_value());
    EXPECT_GT(*findings.smallest[0], 0.01);
    EXPECT_LT(*findings.smallest[0], 0.04);
    EXPECT_NE(report(findings, "md").find("smallest rise found"), std::string::npos);
}

TEST(Changes, OfTimesBelowTheGatesFloorAreNone) {
    std::vector<Commit> commits = costs(1, 1);
    for (std::size_t i = 0; i < commits.size(); ++i) commits[i].records[0].values["cost.time.ratio"] = i < 10 ? 1 : 1.009;
    EXPECT_TRUE(findingsOf(commits, {{"cost.time.ratio"}, {}, {}}).changes.empty());
    for (std::size_t i = 0; i < commits.size(); ++i) commits[i].records[0].values["cost.time.ratio"] = i < 10 ? 1 : 1.011;
    EXPECT_EQ(findingsOf(commits, {{"cost.time.ratio"}, {}, {}}).changes.size(), 1U);
}

TEST(Report, JsonHoldsEveryPointAndTheChange) {
    const auto json = nlohmann::json::parse(report(findingsOf(leaks({0.1, 0.1, 0.4}), onlyLeak), "json"));
    EXPECT_EQ(json["commits"].size(), 3U);
    ASSERT_EQ(json["series"].size(), 1U);
    EXPECT_EQ(json["series"][0]["points"].size(), 3U);
    EXPECT_EQ(json["series"][0]["levels"].size(), 2U);
    ASSERT_EQ(json["changes"].size(), 1U);
    EXPECT_EQ(json["changes"][0]["direction"], "worse");
    EXPECT_EQ(json["changes"][0]["before"]["last"], hashOf(1));
    EXPECT_EQ(json["changes"][0]["after"]["first"], hashOf(2));
}

TEST(Report, WritesAPageWithAChartForEachMetricThatHasSeveralCommits) {
    const TemporaryFolder folder;
    const auto files = writeReport(findingsOf(leaks({0.1, 0.1, 0.4})), folder.path());
    const std::string page = readFile(folder.path() / "report.md");
    EXPECT_NE(page.find("](accuracy.leak-dueling-frusta.svg)"), std::string::npos) << page;
    EXPECT_NE(page.find("10 % (1000000 … 1000001) → 40 % (1000002)"), std::string::npos) << page;
    for (const auto& file : files) EXPECT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_GT(files.size(), 5U);
}

class HistoryFolder : public testing::Test {
protected:
    void write(const std::string& name, const std::vector<Record>& records) const {
        writeRecords(folder_.path() / name, records);
    }
    [[nodiscard]] Stored read() const { return readHistory(folder_.path()); }
    [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }

private:
    TemporaryFolder folder_;
};

TEST_F(HistoryFolder, IsReadByDateAndARecordCountsOnce) {
    Record early = hardRecord(), late = hardRecord();
    early.commit = hashOf(1);
    late.commit = hashOf(0);
    write("20260102T000000Z-aaaaaaaaaaaa-00000000.jsonl", {late});
    write("20260101T000000Z-bbbbbbbbbbbb-00000000.jsonl", {early});
    Record other = early;
    other.scene = "simple";
    write("20260101T000000Z-bbbbbbbbbbbb-11111111.jsonl", {early, other});
    const Stored stored = read();
    EXPECT_TRUE(stored.unreadable.empty());
    ASSERT_EQ(stored.commits.size(), 2U);
    EXPECT_EQ(stored.commits[0].hash, hashOf(1));
    EXPECT_EQ(stored.commits[0].records.size(), 2U);
}

TEST_F(HistoryFolder, RecordsOfAnotherSchemaAreLeftOutAndNamed) {
    write("20260101T000000Z-c0ffee-00000000.jsonl", {hardRecord()});
    writeFile(path() / "20250101T000000Z-dead-00000000.jsonl", "{\"schema_version\":0}\n");
    writeFile(path() / "report.md", "# Past commits\n");
    const Stored stored = read();
    EXPECT_EQ(stored.commits.size(), 1U);
    ASSERT_EQ(stored.unreadable.size(), 1U);
    EXPECT_NE(stored.unreadable[0].find("20250101T000000Z-dead-00000000.jsonl:1"), std::string::npos);
}

TEST(Stored, AFolderThatIsNoneIsNamed) {
    const TemporaryFolder folder;
    const std::string file = folder.path() / "history";
    writeFile(file, "");
    const std::string message = test::messageOf<BadInput>([&] { (void)readHistory(file); });
    EXPECT_TRUE(message.starts_with("cannot read the history " + file + ": ")) << message;
}

} // namespace
} // namespace shadowbench::history
