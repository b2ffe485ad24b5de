// The documents' tables and figures with our records beside them.
#include "base/error.h"
#include "scene/load/load.h"
#include "studies/claims/claims.h"
#include "studies/papers/papers.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"
#include "tests/support/expected_techniques.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

Record with(const std::string& variant, double rmse) {
    Record record = test::hardRecord();
    record.scene = "s";
    record.variant = variant;
    record.values["accuracy.rmse"] = rmse;
    record.values.list("stability.by_frame.rmse").clear();
    return record;
}

const std::string table = R"([{"id": "t", "title": "T", "where": "W", "says": "S", "table": {
    "columns": [{"title": "error", "scene": "s", "profile": "gate", "metric": "accuracy.rmse"},
                {"title": "ms", "scene": "s", "profile": "gate", "metric": "accuracy.rmse", "per": "b"}],
    "rows": [{"title": "A", "variant": "a", "published": [1, 30]},
             {"title": "B", "variant": "b", "published": [2, 10]},
             {"title": "C", "variant": "c", "published": [3, null]}]}}])";

TEST(Papers, ATableHasTheirNumbersAndOursAndTheRankCorrelation) {
    const std::vector<PaperPage> pages = parsePaperPages(table);
    const std::vector<Record> records{with("a", 0.1), with("b", 0.2), with("c", 0.4)};
    EXPECT_EQ(paperPage(pages.front(), records, {}), "## T\n\nW. S.\n\n"
                                                     "| published as | variant | error | ours | ms | × b | ours × b |\n"
                                                     "|:---|:---|---:|---:|---:|---:|---:|\n"
                                                     "| A | a | 1 | 0.1 | 30 | 3 | 0.5 |\n"
                                                     "| B | b | 2 | 0.2 | 10 | 1 | 1 |\n"
                                                     "| C | c | 3 | 0.4 | – | – | 2 |\n"
                                                     "| rank correlation | | | 1 | | | -1 |\n\n");
}

TEST(Papers, WhatNoRecordHasIsADash) {
    const std::vector<PaperPage> pages = parsePaperPages(table);
    const std::string text = paperPage(pages.front(), {with("a", 0.1)}, {"t.svg"});
    EXPECT_NE(text.find("| A | a | 1 | 0.1 | 30 | 3 | – |"), std::string::npos) << text; // no unit to divide by
    EXPECT_NE(text.find("| B | b | 2 | – | 10 | 1 | – |"), std::string::npos) << text;
    EXPECT_NE(text.find("![T](t.svg)"), std::string::npos);
}

TEST(Papers, AChartTakesTheLongestCurveAndLevels) {
    const PaperChart chart{"title", "s", {"temporal", "still", "none"}};
    Record run = with("temporal", 0.1), sweep = with("temporal", 0.1);
    run.values.list("stability.by_frame.rmse") = {0.5, 0.25};
    sweep.values.list("stability.by_frame.rmse") = {0.5, 0.25, 0.125};
    sweep.sweep = SweepStep{"still-frames", "frames", "temporal", 3, {}};
    const auto svg = paperChart(chart, {run, sweep, with("still", 0.3)});
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("temporal"), std::string::npos);
    EXPECT_NE(svg->find("still"), std::string::npos);
    EXPECT_EQ(svg->find(">none<"), std::string::npos);
    EXPECT_FALSE(paperChart(chart, {}));
}

TEST(Papers, MistakesNamePageAndKey) {
    const auto message = [](const std::string& json) -> std::string {
        try {
            parsePaperPages(json);
        } catch (const BadInput& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message("{}"), "reading papers: not a JSON list");
    EXPECT_EQ(message(R"([{"id": "t", "titel": "T"}])"), "reading papers: t: \"titel\" is no key");
    EXPECT_EQ(message(R"([{"id": "t", "title": "T", "where": "w", "says": "s", "charts": {"title": "C"}}])"),
              "reading papers: t: \"charts\" must be a list");
    std::string short_ = table;
    short_.replace(short_.find("[2, 10]"), 7, "[2]");
    EXPECT_EQ(message(short_), "reading papers: t: the row \"B\" has 1 numbers for 2 columns");
}

/// A variant's canonical name, by which records are found; of techniques still to come as it is.
std::string canonical(const std::string& variant) {
    return isToCome(idOf(variant)) ? variant : techniques::parseVariant(variant).name;
}

TEST(Papers, TheProgramsOwnNameWhatRecordsCanHave) {
    const std::vector<std::string> scenes = builtinScenes();
    const auto isScene = [&](const std::string& id) { return std::ranges::find(scenes, id) != scenes.end(); };
    for (const PaperPage& page : paperPages()) {
        for (const PaperChart& chart : page.charts) {
            EXPECT_TRUE(isScene(chart.scene)) << chart.scene;
            for (const std::string& variant : chart.variants) EXPECT_EQ(canonical(variant), variant);
        }
        if (!page.table) continue;
        for (const PaperColumn& column : page.table->columns) EXPECT_TRUE(isScene(column.scene)) << column.scene;
        for (const PaperRow& row : page.table->rows) EXPECT_EQ(canonical(row.variant), row.variant);
    }
    for (const Claim& claim : claims())
        for (const auto& checks : {claim.checks, claim.ruledOut})
            for (const Check& check : checks)
                for (const Figure& figure : figuresOf(check)) {
                    EXPECT_TRUE(isScene(figure.scene)) << claim.id << ": " << figure.scene;
                    EXPECT_EQ(canonical(figure.variant), figure.variant) << claim.id;
                    const std::string over = figure.over ? figure.over->variant : figure.variant;
                    EXPECT_EQ(canonical(over), over) << claim.id;
                }
}

TEST(Papers, MultiplesAreOfAnyUnitButZero) {
    const std::vector<PaperPage> pages = parsePaperPages(table);
    const std::string one = paperPage(pages.front(), {with("a", 0.5), with("b", 1)}, {});
    EXPECT_NE(one.find("| A | a | 1 | 0.5 | 30 | 3 | 0.5 |"), std::string::npos) << one;
    const std::string none = paperPage(pages.front(), {with("a", 0.5), with("b", 0)}, {});
    EXPECT_NE(none.find("| A | a | 1 | 0.5 | 30 | 3 | – |"), std::string::npos) << none;
}

} // namespace
} // namespace shadowbench
