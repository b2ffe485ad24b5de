// What reports say of findings that are made by hand.
#include "base/temporary_folder.h"
#include "history/history_report.h"
#include "tests/support/records_examples.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace shadowbench::history {
namespace {

std::string hashOf(std::size_t index) { return std::to_string(1000000 + index) + std::string(33, 'a'); }

/// A series of one figure a commit from the first on, and its levels.
void add(Findings& f, const Series& named, const std::vector<double>& figures, const std::vector<Level>& levels) {
    Series& series = f.history.series.emplace_back(named);
    for (std::size_t i = 0; i < figures.size(); ++i) series.points.push_back({i, figures[i], 0});
    f.levels.push_back(levels);
    f.smallest.emplace_back();
}

Series leakOf(const std::string& variant) {
    return {"simple", variant, "accuracy.leak", "gate 256²", gate::Class::Leak, false, "", {}};
}

/// Of four commits: pcf leaks more from the third on, esm is scored up to the second only, vsm is as it was.
Findings fourCommits() {
    Findings f;
    for (std::size_t i = 0; i < 4; ++i) {
        f.history.commits.push_back({hashOf(i), "2026010" + std::to_string(i + 1) + "T000000Z", {}});
        f.subjects.push_back("subject " + std::to_string(i));
    }
    add(f, leakOf("pcf"), {0.1, 0.1, 0.4, 0.4}, {{0, 1, 0.1, 2}, {2, 3, 0.4, 2}});
    add(f, leakOf("esm"), {0.2, 0.2}, {{0, 1, 0.2, 2}});
    add(f, leakOf("vsm"), {0.3, 0.3, 0.3, 0.3}, {{0, 3, 0.3, 4}});
    Series other = leakOf("esm");
    other.metric = "accuracy.rmse";
    add(f, other, {0.05, 0.05}, {{0, 1, 0.05, 2}});
    f.events = {{"vanished", 1, 1}, {"vanished", 3, 1}, {"began", 2, 0}};
    f.changes = {{0, f.levels[0][0], f.levels[0][1], gate::Direction::Worse, 0.75}};
    f.suspects = {{1, 2, 1, "", {0}}};
    return f;
}

TEST(HistoryReport, AsTextNamesEachChangeAndEvent) {
    EXPECT_EQ(report(fourCommits(), "text"),
              R"( metric          technique    scene           from     to   size   first seen at   last without   suspects
 accuracy.leak         pcf   simple   worse   10 %   40 %   75 %         1000002        1000001   this one
 what       technique    scene        cell         metrics        at
 began            vsm   simple   gate 256²   accuracy.leak   1000000
 vanished         esm   simple   gate 256²               2   1000001
4 commits from 1000000 to 1000003, 3 of 4 series without a change; 1 began, 2 vanished, 0 broke off, 0 in error
)");
}

TEST(HistoryReport, AsMarkdownHasATableForEachMetricOfAScene) {
    const std::string page = report(fourCommits(), "md");
    EXPECT_EQ(page.substr(page.find("## simple")), R"(## simple

### accuracy.leak

| technique | cell | figures | levels | smallest rise found | apart because |
|:---|---:|---:|---:|---:|---:|
| pcf | gate 256² | 4 | 10 % (1000000 … 1000001) → 40 % (1000002 … 1000003) |  |  |
| esm | gate 256² | 2 | 20 % (1000000 … 1000001) |  |  |
| vsm | gate 256² | 4 | 30 % (1000000 … 1000003) |  |  |

### accuracy.rmse

| technique | cell | figures | levels | smallest rise found | apart because |
|:---|---:|---:|---:|---:|---:|
| esm | gate 256² | 2 | 0.05 (1000000 … 1000001) |  |  |

## Commits

| commit | made | subject |
|:---|---:|---:|
| 1000000 | 20260101T000000Z | subject 0 |
| 1000001 | 20260102T000000Z | subject 1 |
| 1000002 | 20260103T000000Z | subject 2 |
| 1000003 | 20260104T000000Z | subject 3 |
)");
}

TEST(HistoryReport, AsJsonNamesTheSuspectsThatAreKnown) {
    Findings f = fourCommits();
    const auto change = [&] { return nlohmann::json::parse(report(f, "json"))["changes"][0]; };
    EXPECT_EQ(change()["suspects"], 1);
    EXPECT_FALSE(change().contains("narrow")) << "it is the one";
    f.suspects[0].commits = 2;
    f.suspects[0].middle = hashOf(9);
    EXPECT_EQ(change()["suspects"], 2);
    EXPECT_EQ(change()["narrow"], "SCENES='simple' TECHNIQUES='pcf' tools/backfill 1000009");
    f.suspects[0] = {1, 2, 0, "", {0}};
    EXPECT_FALSE(change().contains("suspects"));
}

TEST(HistoryReport, OfAFolderSaysWhatVanished) {
    const TemporaryFolder folder;
    Record before = test::hardRecord(), after = test::hardRecord();
    before.commit = hashOf(0);
    after.commit = hashOf(1);
    after.values["accuracy.leak"].reset();
    writeRecords(folder.path() / "20260101T000000Z-aaaaaaaaaaaa-00000000.jsonl", {before});
    writeRecords(folder.path() / "20260102T000000Z-bbbbbbbbbbbb-00000000.jsonl", {after});
    const Findings findings = findingsOf(folder.path(), {{"accuracy.leak", "accuracy.false_shadow"}, {}, {}});
    ASSERT_EQ(findings.events.size(), 1U);
    EXPECT_EQ(findings.events[0].what, "vanished");
    EXPECT_EQ(findings.history.series[findings.events[0].series].metric, "accuracy.leak");
}

std::size_t countOf(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(HistoryChart, NamesTheSeriesThatChange) {
    const std::string svg = chart(fourCommits(), "accuracy.leak", "simple");
    EXPECT_EQ(countOf(svg, ">pcf<"), 1U);
    EXPECT_EQ(countOf(svg, ">vsm<"), 0U);
}

TEST(HistoryChart, ShowsEachFigureOfEitherSign) {
    Findings f = fourCommits();
    f.changes.clear();
    Series pops = leakOf("lod-dither");
    pops.metric = "lod.walk_pop"; // beyond that of all triangles, or less
    add(f, pops, {0.1, -0.3, 0.05, -0.1}, {{0, 3, 0.1, 4}});
    const std::string svg = chart(f, "lod.walk_pop", "simple");
    EXPECT_EQ(countOf(svg, "<use xlink:href='#gpPt6'"), 4U);
}

} // namespace
} // namespace shadowbench::history
