// Charts as Chromium lays them out, where the boxes of texts are those that a reader sees.
#include "base/files.h"
#include "base/temporary_folder.h"
#include "report/charts.h"
#include "tests/browser/checks.h"
#include "tests/support/report_examples.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <iterator>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> chartsOf(const fs::path& folder, const std::string& kind) {
    std::vector<fs::path> charts;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".svg" && entry.path().filename().string().starts_with(kind))
            charts.push_back(entry.path());
    std::ranges::sort(charts);
    return charts;
}

// A pixel is what rounding and the sides of letters have in common.
constexpr const char* crossing = R"js((() => {
    const boxOf = (e) => {
      const box = e.getBoundingClientRect();
      return { left: box.left + 1, right: box.right - 1, top: box.top + 1, bottom: box.bottom - 1 };
    };
    const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    const texts = [...document.querySelectorAll("text")].filter((e) => e.textContent.trim())
      .map((e) => ({ words: e.textContent.trim(), box: boxOf(e) }));
    const marks = [...document.querySelectorAll("use, circle")].filter((e) => !e.closest("defs")).map(boxOf);
    const frame = boxOf(document.documentElement);
    const found = [];
    texts.forEach(({ words, box }, i) => {
      if (box.left < frame.left || box.right > frame.right || box.top < frame.top || box.bottom > frame.bottom)
        found.push(`"${words}" is cut`);
      for (const other of texts.slice(i + 1)) if (meet(box, other.box)) found.push(`"${words}" crosses "${other.words}"`);
      if (marks.some((mark) => meet(box, mark))) found.push(`"${words}" crosses a mark`);
    });
    return found;
})())js";

TEST(ChartFiles, OfErrorAgainstCostHaveNoLabelOnAnotherOnAMarkOrCut) {
    const auto tab = chromium().tab();
    std::vector<fs::path> charts = chartsOf(fs::path(SOURCE_FOLDER) / "results", "pareto-");
    EXPECT_GE(charts.size(), 10U);
    std::ranges::move(chartsOf(fs::path(SOURCE_FOLDER) / "results", "modelled-"), std::back_inserter(charts));
    for (const fs::path& chart : charts) {
        tab->open(chart);
        const nlohmann::json found = tab->value(crossing);
        EXPECT_EQ(found, nlohmann::json::array()) << chart;
        EXPECT_GT(tab->value("document.querySelectorAll('use, circle').length"), 3) << chart;
    }
}

TEST(ChartFiles, HaveRoomForTheNamesOfAllFamiliesBesideOtherRenderers) {
    std::vector<Record> records;
    for (const char* technique :
         {"planar-hard", "sm-uniform", "vsm", "pcss", "volume-zfail", "temporal-sampling", "pcf-vogel", "prt-sh", "mine"})
        records.push_back(test::hardCell(technique, 0.01 + 0.01 * static_cast<double>(records.size()),
                                         1 + static_cast<double>(records.size())));
    for (int i = 0; i < 40; ++i) {
        Record& other = records.emplace_back(test::hardCell("", 0.02 + 0.001 * i, 1));
        other.technique = other.variant = fmt::format("external:engine-{}", i);
    }
    const TemporaryFolder folder;
    const fs::path chart = folder.path() / "chart.svg";
    const std::optional<std::string> svg = report::paretoChart(records, records.front().scene);
    ASSERT_TRUE(svg);
    writeFile(chart, *svg);
    const auto tab = chromium().tab();
    tab->open(chart);
    EXPECT_EQ(tab->value(crossing), nlohmann::json::array());
}

} // namespace
} // namespace shadowbench::browser
