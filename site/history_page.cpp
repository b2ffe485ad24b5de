// Figures over commits: what changed, and a chart for each metric and scene.
#include "report/summary.h"
#include "site/charts.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/technique_facts.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

using history::Findings;
using history::Series;

constexpr const char* historyAddress = "history.html";

std::string commitAt(const Findings& f, std::size_t commit) { return history::shortHash(f.history.commits[commit].hash); }

Table changeTable(const Findings& f) {
    Table table{.id = "changes", .caption = "What changed, the largest first", .rows = {}, .headed = false, .stacked = true};
    table.columns = {{.title = "technique", .number = false},
                     {.title = "is", .number = false},
                     {.title = "scene", .number = false},
                     {.title = "metric", .number = false},
                     {.title = "before"},
                     {.title = "after"},
                     {.title = "size", .hint = "The share of the larger level that the change is"},
                     {.title = "first seen at", .number = false},
                     {.title = "suspects", .hint = "Commits that may have made the change"}};
    for (const history::LevelChange& change : f.changes) {
        const Series& series = f.history.series[change.series];
        const auto suspects = std::ranges::find_if(f.suspects, [&](const history::Suspects& s) {
            return s.old == change.before.last && s.now == change.after.first;
        });
        const std::size_t commits = suspects == f.suspects.end() ? 0 : suspects->commits;
        const std::string subject = f.subjects[change.after.first];
        const bool worse = change.direction == gate::Direction::Worse;
        table.rows.push_back(
            {{Cell{.text = series.variant, .note = factsOf(techniques::idOfVariant(series.variant)).title},
              Cell{.text = worse ? "worse" : "better", .kind = worse ? "refuted" : "reproduced"}, Cell{series.scene},
              Cell{series.metric}, Cell{history::formatFigure(series.metric, change.before.value), change.before.value},
              Cell{history::formatFigure(series.metric, change.after.value), change.after.value},
              Cell{report::percent(change.size), change.size},
              Cell{.text = commitAt(f, change.after.first), .note = subject},
              commits > 0 ? Cell{std::to_string(commits), static_cast<double>(commits)} : Cell{"–"}},
             {}});
    }
    return table;
}

/// A row a series, a column a commit.
Table seriesTable(const Findings& f, const std::string& scene, const std::string& metric) {
    Table table{.id = slug(fmt::format("{}-{}", scene, metric)),
                .caption = fmt::format("{} on {}", metric, scene),
                .columns = {{.title = "technique", .number = false}},
                .rows = {}};
    const history::Unit unit = history::unitOf(metric);
    for (std::size_t i = 0; i < f.history.commits.size(); ++i)
        table.columns.push_back({.title = commitAt(f, i),
                                 .hint = f.subjects[i],
                                 .key = std::to_string(i + 1),
                                 .unit = unit.name == " %" ? "share" : "1"});
    for (std::size_t i = 0; i < f.history.series.size(); ++i) {
        const Series& series = f.history.series[i];
        if (series.scene != scene || series.metric != metric) continue;
        Row row{{Cell{.text = series.variant, .note = series.cell}},
                {{"family", factsOf(techniques::idOfVariant(series.variant)).family},
                 {"changed", f.levels[i].size() > 1 ? "yes" : "no"}}};
        row.cells.resize(f.history.commits.size() + 1, Cell{"–"});
        for (const history::Point& point : series.points)
            row.cells[point.commit + 1] = {history::formatFigure(metric, point.value), point.value};
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

void addHistoryPage(const Findings& f, SiteWriter& site) {
    Data data, charts{Data::type::list};
    for (const auto& [scene, metric] : history::chartedMetrics(f)) {
        const Table series = seriesTable(f, scene, metric);
        const std::string name = "charts/history-" + slug(fmt::format("{}-{}", scene, metric));
        writeChart(site, name, history::chart(f, metric, scene));
        Data entry;
        entry.set("heading", fmt::format("{} on {}", metric, truncate(scene)));
        entry.set("chart", site.chart(historyAddress, {.name = name,
                                                       .title = fmt::format("{} on {}, by commit", metric, truncate(scene)),
                                                       .text = "The figures are in the table below.",
                                                       .kind = "lines",
                                                       .table = series.id,
                                                       .options = {{"xlabel", "commit"}, {"ylabel", metric}}}));
        entry.set("table", site.table(historyAddress, series));
        charts << entry;
    }
    data.set("span", history::summaryOf(f) + ".");
    data.set("changes", site.table(historyAddress, changeTable(f)));
    data.set("charts", charts);
    site.add({historyAddress, "History", render("history.html", data)});
}

} // namespace shadowbench::site
