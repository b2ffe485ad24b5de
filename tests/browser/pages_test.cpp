// Every page of the site that a run ends with, opened from its file. Another site: SHADOWBENCH_SITE=FOLDER names it.
#include "tests/browser/browser.h"
#include "tests/browser/checks.h"
#include "tests/browser/tiny_run.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

Browser& chromium() {
    static Browser browser;
    return browser;
}

fs::path siteFolder() {
    const char* chosen = std::getenv("SHADOWBENCH_SITE");
    return chosen != nullptr ? fs::path(chosen) : tinyRun().folder();
}

TEST(Pages, AreThereAndTheFirstIsTheIndex) {
    EXPECT_TRUE(fs::exists(siteFolder() / "index.html"));
    EXPECT_GE(pagesOf(siteFolder()).size(), 3U);
}

TEST(Pages, LoadWithoutComplaintAndFitPhonesAndWideScreens) {
    const auto tab = chromium().tab();
    for (const fs::path& page : pagesOf(siteFolder())) {
        tab->open(page);
        EXPECT_EQ(overflow(*tab, 400, 800), Sentences()) << page;
        EXPECT_EQ(overflow(*tab, 2560, 1440), Sentences()) << page;
    }
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST(Pages, NameWhatTheyShowAndLeadOnlyToFilesThatAreThere) {
    for (const fs::path& page : pagesOf(siteFolder())) {
        const auto tab = chromium().tab();
        tab->open(page);
        EXPECT_EQ(faultsOf(*tab, page), Sentences());
    }
}

TEST(Pages, HaveEveryTableAndPictureWithoutJavaScript) {
    const auto tab = chromium().tab({.scripts = false});
    for (const fs::path& page : pagesOf(siteFolder())) {
        tab->open(page);
        EXPECT_EQ(missingContent(*tab), Sentences()) << page;
    }
}

/// Presses the head of the first column of numbers of the table that has most rows; then says what its cells hold.
constexpr const char* pressed = R"((() => {
    const size = (table) => table.tBodies[0].rows.length;
    const table = [...document.querySelectorAll('table[data-table]')].sort((a, b) => size(b) - size(a))[0];
    const rows = () => [...table.tBodies[0].rows];
    const column = [...table.tHead.rows[0].cells].findIndex(
        (head, i) => new Set(rows().map((row) => row.cells[i].dataset.v).filter(Boolean)).size > 2);
    table.tHead.rows[0].cells[column].querySelector('button').click();
    return rows().map((row) => row.cells[column].dataset.v).map((v) => v === undefined ? null : Number(v));
})())";

std::vector<double> numbersOf(const nlohmann::json& cells) {
    std::vector<double> numbers;
    for (const nlohmann::json& cell : cells)
        if (!cell.is_null()) numbers.push_back(cell);
    return numbers;
}

TEST(Pages, SortATableWhenAHeadIsPressed) {
    const auto tab = chromium().tab();
    tab->open(siteFolder() / "index.html");
    const std::vector<double> rising = numbersOf(tab->value(pressed));
    EXPECT_GE(rising.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(rising));
    const std::vector<double> falling = numbersOf(tab->value(pressed));
    EXPECT_TRUE(std::ranges::is_sorted(falling, std::greater<>()));
    EXPECT_EQ(falling.size(), rising.size());
}

TEST(Pages, FilterATableByName) {
    const auto tab = chromium().tab();
    tab->open(siteFolder() / "index.html");
    const std::string shown = "[...document.querySelector('form[data-filters] + * table, form[data-filters] ~ * table')"
                              ".tBodies[0].rows].filter((row) => !row.hidden).map((row) => row.cells[0].innerText.trim())";
    const std::size_t all = tab->value(shown).size();
    const nlohmann::json some =
        tab->value("(() => { const text = document.querySelector('form[data-filters] input[type=search]');"
                   "text.value = 'pcf'; text.dispatchEvent(new Event('input', {bubbles: true}));"
                   "return " +
                   shown + "; })()");
    EXPECT_GT(all, some.size());
    ASSERT_FALSE(some.empty());
    for (const std::string name : some) EXPECT_NE(name.find("pcf"), std::string::npos) << name;
}

} // namespace
} // namespace shadowbench::browser
