// The pages of sweeps: a quantity of a scene moves, and techniques break.
#include "report/charts.h"
#include "report/lod_report.h"
#include "report/summary.h"
#include "site/charts.h"
#include "site/names.h"
#include "site/pages.h"
#include "site/technique_facts.h"
#include "studies/sweep/axis.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::site {
namespace {

std::string titleOf(const Sweep& sweep) { return fmt::format("{} over {}", truncate(sweep.scene), truncate(sweep.axis)); }

std::string axisLabel(const Sweep& sweep) {
    const SweepStep& step = *sweep.records.front().sweep;
    return truncate(step.unit.empty() ? step.axis : fmt::format("{} [{}]", step.axis, step.unit));
}

bool isLogarithmic(const std::string& axis) {
    const auto found = std::ranges::find(axes(), axis, &Axis::id);
    return found != axes().end() && found->logarithmic;
}

std::vector<double> axisValues(const Sweep& sweep) {
    std::vector<double> values;
    for (const Record& record : sweep.records)
        if (std::ranges::find(values, record.sweep->value) == values.end()) values.push_back(record.sweep->value);
    return values;
}

/// What the curves show: frame times of levels of detail, else the first tolerance's metric, else the headline.
std::string metricOf(const Sweep& sweep) {
    const auto limit = report::tolerance(sweep.records, sweep.scene);
    return limit ? limit->metric : report::headlineMetric(sweep.records, sweep.scene);
}

Cell cellOf(const Record& record, const std::string& metric) {
    if (record.status == Status::Error) return {.text = "error", .note = record.reason};
    if (isLevelOfDetail(record)) {
        const std::optional<double>& time = record.values["lod.time.median"];
        return time ? Cell{fmt::format("{:.2f}", *time), *time} : Cell{"–"};
    }
    const std::optional<double> error = wasScored(record.status) ? metrics::bounded(record.values, metric) : std::nullopt;
    return error ? Cell{report::formatValue(metric, *error), *error} : Cell{"–"};
}

Cell breakCell(const Row& row, const Record& record) {
    const bool measured = std::ranges::any_of(row.cells, [](const Cell& cell) { return cell.value.has_value(); });
    if (record.sweep->breakPoint) return {fmt::format("{:g}", *record.sweep->breakPoint), *record.sweep->breakPoint};
    return {measured ? "holds" : "–"};
}

Table curveTable(const Sweep& sweep) {
    const std::vector<double> values = axisValues(sweep);
    const std::string metric = metricOf(sweep);
    const bool lod = isLevelOfDetail(sweep.records.front());
    Table table{.id = "curves",
                .caption = titleOf(sweep),
                .columns = {{.title = "technique", .number = false}},
                .rows = {},
                .filtered = true};
    for (const double value : values)
        table.columns.push_back({.title = fmt::format("{:g}", value),
                                 .hint = axisLabel(sweep),
                                 .key = fmt::format("{}", value),
                                 .unit = lod                       ? "ms"
                                         : report::isShare(metric) ? "share"
                                                                   : "1"});
    if (!lod) table.columns.push_back({.title = "breaks at", .hint = "The first value at which the tolerance is exceeded"});
    std::vector<std::string> curves;
    for (const Record& record : sweep.records)
        if (std::ranges::find(curves, record.sweep->curve) == curves.end()) curves.push_back(record.sweep->curve);
    for (const std::string& curve : curves) {
        Row row{{Cell{curve}}, {}};
        row.cells.resize(values.size() + 1, Cell{"–"});
        const Record* last = nullptr;
        for (const Record& record : sweep.records) {
            if (record.sweep->curve != curve) continue;
            const auto at = std::ranges::find(values, record.sweep->value) - values.begin();
            row.cells[static_cast<std::size_t>(at) + 1] = cellOf(record, metric);
            last = &record;
        }
        const TechniqueFacts facts = factsOf(last->technique);
        row.marks = {{"family", facts.family},
                     {"answer", facts.answer},
                     {"within", last->sweep->breakPoint ? "no" : "yes"},
                     {"baseline", report::isBaseline(*last) ? "yes" : "no"}};
        row.cells[0].note = facts.title;
        if (!lod) row.cells.push_back(breakCell(row, *last));
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

std::vector<Sweep> sweepsOf(const std::vector<Record>& records) {
    std::vector<Sweep> sweeps;
    for (const Record& record : records) {
        if (!record.sweep) continue;
        const auto same = [&](const Sweep& sweep) {
            return sweep.scene == record.scene && sweep.axis == record.sweep->axis;
        };
        auto sweep = std::ranges::find_if(sweeps, same);
        if (sweep == sweeps.end()) sweep = sweeps.insert(sweeps.end(), {record.scene, record.sweep->axis, {}});
        sweep->records.push_back(record);
    }
    return sweeps;
}

std::string sweepAddress(const Sweep& sweep) { return fmt::format("sweeps/{}.html", slug(sweep.scene + "-" + sweep.axis)); }

void addSweepPage(const Sweep& sweep, SiteWriter& site) {
    const std::string address = sweepAddress(sweep), name = "charts/sweep-" + slug(sweep.scene + "-" + sweep.axis);
    const bool lod = isLevelOfDetail(sweep.records.front()), logarithmic = isLogarithmic(sweep.axis);
    const std::optional<std::string> svg =
        lod ? std::optional(report::viewportChart(sweep.records)) : report::sweepChart(sweep.records, logarithmic);
    const std::optional<report::Tolerance> limit = report::tolerance(sweep.records, sweep.scene);
    Chart chart{.name = name,
                .title = titleOf(sweep),
                .text = titleOf(sweep) + "; the figures are in the table below.",
                .kind = "lines",
                .table = "curves",
                .options = {{"xlabel", axisLabel(sweep)},
                            {"ylabel", lod ? "ms a frame" : report::meaning(metricOf(sweep))},
                            {"xlog", logarithmic ? "yes" : "no"}}};
    if (limit && !lod) chart.options.emplace_back("tolerance", fmt::format("{}", limit->value));
    if (svg) writeChart(site, name, *svg);
    Data data;
    data.set("title", titleOf(sweep));
    data.set("described",
             lod ? "Frame times of techniques for levels of detail over the side of the picture."
                 : fmt::format("{}{}. A technique breaks at the first value at which it exceeds the tolerance.",
                               report::meaning(metricOf(sweep)), limit ? ", tolerance " + report::formatBound(*limit) : ""));
    data.set("chart", svg ? site.chart(address, chart) : std::string());
    data.set("table", site.table(address, curveTable(sweep)));
    site.add({address, titleOf(sweep), render("chart-page.html", data)});
}

void addSweepList(const std::vector<Sweep>& sweeps, SiteWriter& site) {
    Table table{.id = "sweeps", .caption = "Quantities that were moved", .rows = {}, .headed = false, .stacked = true};
    table.columns = {{.title = "sweep", .number = false},
                     {.title = "techniques"},
                     {.title = "break"},
                     {.title = "hold to the end", .number = false}};
    for (const Sweep& sweep : sweeps) {
        const Table curves = curveTable(sweep);
        std::vector<std::string> holding;
        std::size_t broken = 0;
        for (const Row& row : curves.rows) {
            const Cell& last = row.cells.back();
            if (last.text == "holds") holding.push_back(truncate(row.cells.front().text));
            broken += curves.columns.back().title == "breaks at" && last.value ? 1 : 0;
        }
        const std::size_t most = 6, named = std::min(holding.size(), most);
        std::string text =
            fmt::format("{}", fmt::join(holding.begin(), holding.begin() + static_cast<std::ptrdiff_t>(named), ", "));
        if (holding.size() > most) text += fmt::format(" and {} more", holding.size() - most);
        const auto count = [](std::size_t number) { return Cell{std::to_string(number), static_cast<double>(number)}; };
        table.rows.push_back({{Cell{.text = titleOf(sweep), .address = sweepAddress(sweep)}, count(curves.rows.size()),
                               count(broken), Cell{text.empty() ? "–" : text}},
                              {}});
    }
    Data data;
    data.set("title", "Sweeps");
    data.set("described", "One quantity of a scene moves from harmless to hard; where does each technique break?");
    data.set("chart", "");
    data.set("table", site.table("sweeps.html", table));
    site.add({"sweeps.html", "Sweeps", render("chart-page.html", data)});
}

} // namespace shadowbench::site
