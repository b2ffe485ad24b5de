// A hundred techniques on thirty scenes stay usable, and the first view of the published run answers what people come for.
#include "base/files.h"
#include "base/temporary_folder.h"
#include "harness/records/record.h"
#include "report/costing.h"
#include "site/names.h"
#include "site/pages.h"
#include "tests/browser/checks.h"
#include "tests/browser/large_run.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

/// The first page and that of the first scene, with a picture in the place of gnuplot's chart.
void writeSite(const fs::path& folder, const std::vector<Record>& records) {
    site::SiteWriter site(folder, {});
    const fs::path chart = folder / (report::chartName(report::shownCosting(records, "scene-01")) + "-scene-01.svg");
    writeFile(chart, R"(<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>)");
    site::addChoosePage(records, {}, site);
    site::addScenePage(records, "scene-01", {}, {chart}, site);
    site.writeAssets();
}

class LargeSite {
public:
    LargeSite() {
        const fs::path file = folder_.path() / "results.jsonl";
        writeRecords(file, largeRun(100, 30));
        writeSite(folder_.path(), readRecords(file));
    }

    [[nodiscard]] fs::path operator/(const char* page) const { return folder_.path() / page; }

private:
    TemporaryFolder folder_;
};

const LargeSite& largeSite() {
    static const LargeSite site;
    return site;
}

/// Milliseconds that an action takes with the layout after it: {the fastest, the median} of nine times. `action` is a
/// JavaScript function of the number of the time.
std::pair<double, double> milliseconds(Tab& tab, const std::string& action) {
    const auto times = tab.value("(() => { const act = " + action + R"js(; const times = [];
        for (let i = 0; i < 9; ++i) {
          const start = performance.now();
          act(i);
          document.body.getBoundingClientRect();
          times.push(performance.now() - start);
        }
        return times.sort((a, b) => a - b); })())js");
    return {times[0], times[4]};
}

constexpr const char* sorting =
    "(i) => document.querySelectorAll('table[data-table=TABLE] thead button')[1 + i % 3].click()";
constexpr const char* filtering = R"js((i) => {
    const text = document.querySelector('form[data-filters=TABLE] input[type=search]');
    text.value = ['pcf', '', 'map=1', 'nothing'][i % 4];
    text.dispatchEvent(new Event('input', { bubbles: true }));
})js";

// 100 ms are the aim. The bound for the fastest of nine times is four times as far off: other programs may have the
// processor.
TEST(LargeSite, SortsAndFiltersWithinATenthOfASecond) {
    for (const auto& [page, table] : {std::pair("choose.html", "all"), std::pair("scenes/scene-01.html", "errors")}) {
        const auto tab = chromium().tab();
        tab->open(largeSite() / page);
        tab->waitFor("!document.querySelector('figure.chart') || document.querySelector('svg.plot')");
        ASSERT_EQ(tab->value(fmt::format("document.querySelectorAll('[data-table={}] tbody tr').length", table)), 100);
        for (const auto& [what, action] : {std::pair("sorting", sorting), std::pair("filtering", filtering)}) {
            std::string script = action;
            script.replace(script.find("TABLE"), 5, table);
            const auto [least, median] = milliseconds(*tab, script);
            std::printf("%s: %s takes %.1f ms, median %.1f ms\n", page, what, least, median);
            EXPECT_LT(least, 400) << page << ", " << what;
        }
        EXPECT_EQ(tab->complaints(), Sentences());
    }
}

TEST(LargeSite, HasAllRowsInOrderOnceSorted) {
    const auto tab = chromium().tab();
    tab->open(largeSite() / "choose.html");
    const auto shown = tab->value(R"js((async () => {
        const table = document.querySelector('table[data-table=all]');
        table.tHead.rows[0].cells[2].querySelector('button').click();
        await new Promise((done) => setTimeout(done, 50));
        return [...table.tBodies[0].rows].map((row) => Number(row.cells[2].dataset.v));
    })())js");
    ASSERT_EQ(shown.size(), 100U);
    EXPECT_TRUE(std::ranges::is_sorted(shown.get<std::vector<double>>()));
}

TEST(LargeSite, LeadsFromMarkToMarkByArrowsAndToTheRowByEnter) {
    const auto tab = chromium().tab();
    tab->open(largeSite() / "scenes/scene-01.html");
    tab->waitFor("document.querySelector('svg.plot')");
    EXPECT_EQ(tab->value("document.querySelectorAll('svg.plot .dot').length"), 100);
    EXPECT_EQ(tab->value("document.querySelectorAll('svg.plot [tabindex=\"0\"]').length"), 1) << "one stop of the tab key";
    tab->value("document.querySelector('svg.plot [tabindex=\"0\"]').focus()");
    const std::string label = "document.activeElement.getAttribute('aria-label')";
    const std::string first = tab->value(label);
    tab->press("ArrowRight");
    const std::string second = tab->value(label);
    EXPECT_NE(first, second);
    EXPECT_EQ(tab->value("document.querySelector('.hint').hidden"), false);
    tab->press("Enter");
    const std::string lit = tab->value("document.querySelector('tr.lit').cells[0].textContent");
    EXPECT_TRUE(second.starts_with(lit)) << second << " / " << lit;
}

/// They have an error and no cost: without a place of their own they were in the key of the chart and not in the chart.
TEST(SceneChart, HasOtherRenderersBesideWhatItsCostIsKnownOf) {
    const TemporaryFolder folder;
    std::vector<Record> records = largeRun(5, 1);
    for (const char* name : {"external:engine", "external:other-engine"}) {
        Record row = test::hardCell(name, 0.002, 1);
        row.scene = "scene-01";
        row.technique = name;
        row.external = {.title = "An engine", .source = "version 4"};
        row.values["cost.time.ratio"].reset();
        records.push_back(row);
    }
    writeSite(folder.path(), records);
    const auto tab = chromium().tab();
    tab->open(folder.path() / "scenes/scene-01.html");
    tab->waitFor("document.querySelector('svg.plot')");
    const auto labels =
        tab->value("[...document.querySelectorAll('svg.plot .dot')].map((dot) => dot.getAttribute('aria-label'))");
    ASSERT_EQ(labels.size(), 7U);
    EXPECT_EQ(std::ranges::count_if(labels,
                                    [](const nlohmann::json& label) {
                                        return label.get<std::string>().find("not measured here") != std::string::npos;
                                    }),
              2);
    const auto beside = tab->value(R"js((() => {
        const right = document.querySelector('svg.plot .limit').getBoundingClientRect().right;
        return [...document.querySelectorAll('svg.plot .dot')].filter((dot) => dot.getBoundingClientRect().left > right).length;
    })())js");
    EXPECT_EQ(beside, 2);
    EXPECT_EQ(tab->complaints(), Sentences());
    EXPECT_EQ(overlaps(*tab, 400, 800), Sentences());
}

/// Names that lie on another one, on a mark or beyond the frame.
constexpr const char* crossedNames = R"js((() => {
    const boxOf = (e) => e.getBoundingClientRect();
    const meet = (a, b) => a.left + 1 < b.right && b.left + 1 < a.right && a.top + 1 < b.bottom && b.top + 1 < a.bottom;
    const names = [...document.querySelectorAll("svg.plot .name")], others = [...document.querySelectorAll("svg.plot .dot, svg.plot .tick text")];
    const frame = boxOf(document.querySelector("svg.plot"));
    const crossed = names.filter((name, i) => names.slice(0, i).concat(others).some((other) => meet(boxOf(name), boxOf(other))) ||
      boxOf(name).right > frame.right || boxOf(name).left < frame.left);
    return crossed.map((name) => name.textContent);
})())js";

TEST(SceneChart, HasNoNameOnAnotherOrOnAMark) {
    const TemporaryFolder folder;
    std::vector<Record> records = largeRun(90, 1);
    for (std::size_t i = 0; i < 12; ++i) { // a front of close points between the others
        records[i].values["accuracy.mismatch"] = 0.0002 / (1 + static_cast<double>(i));
        records[i].values["cost.time.ratio"] = 1 + 0.2 * static_cast<double>(i);
    }
    writeSite(folder.path(), records);
    const auto tab = chromium().tab();
    tab->open(folder.path() / "scenes/scene-01.html");
    for (const int width : {390, 768, 1280}) {
        tab->resize(width, 800);
        tab->waitFor("document.querySelectorAll('svg.plot .name').length > 3");
        EXPECT_EQ(tab->value(crossedNames), nlohmann::json::array()) << width;
    }
}

TEST(SceneChart, HasItsLongestTitleWholeOnAPhone) {
    const TemporaryFolder folder;
    std::vector<Record> records = largeRun(9, 1);
    for (Record& record : records) record.modelled["gtx-1080@1920x1080"] = {2, 1, 4, false, {}, {}};
    writeSite(folder.path(), records);
    const auto tab = chromium().tab();
    tab->open(folder.path() / "scenes/scene-01.html");
    tab->resize(390, 800);
    tab->waitFor("[...document.querySelectorAll('svg.plot text')].some((text) => text.textContent.includes('modelled:'))");
    EXPECT_EQ(cut(*tab, 390, 800), Sentences());
}

TEST(LargeSite, FitsItsWindow) {
    const auto tab = chromium().tab();
    for (const char* page : {"choose.html", "scenes/scene-01.html"}) {
        tab->open(largeSite() / page);
        for (const auto& [width, height] : {std::pair(400, 800), std::pair(2560, 1440)}) {
            EXPECT_EQ(overflow(*tab, width, height), Sentences()) << page;
            EXPECT_EQ(overlaps(*tab, width, height), Sentences()) << page;
        }
    }
}

TEST(FirstView, OfThePublishedRunSaysForEachSceneWhichTechniqueToTake) {
    const std::vector<Record> records = readRecords(fs::path(SOURCE_FOLDER) / "results/published/results.jsonl");
    const TemporaryFolder folder;
    site::SiteWriter site(folder.path(), {{"Choose", "choose.html"}});
    site::addChoosePage(records, {}, site);
    site.writeAssets();
    const auto tab = chromium().tab({.width = 1280, .height = 800});
    tab->open(folder.path() / "choose.html");
    const auto rows = tab->value(R"js([...document.querySelectorAll('[data-table=answers] tbody tr')].map((row) => {
        const box = row.getBoundingClientRect(), take = row.cells[1];
        return { bottom: box.bottom, right: take.getBoundingClientRect().right, says: take.textContent.trim() };
    }))js");
    EXPECT_GE(rows.size(), 5U);
    for (const auto& row : rows) {
        EXPECT_LE(row["bottom"].get<double>(), 800) << row;
        EXPECT_LE(row["right"].get<double>(), 1280) << row;
        EXPECT_GT(row["says"].get<std::string>().size(), 2U) << row;
    }
    EXPECT_EQ(tab->value("scrollY"), 0);
}

} // namespace
} // namespace shadowbench::browser
