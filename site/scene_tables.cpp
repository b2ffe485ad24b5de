#include "site/scene_tables.h"

#include "harness/metrics/table.h"
#include "report/columns.h"
#include "report/cost_report.h"
#include "report/costing.h"
#include "report/doubts.h"
#include "report/run_report.h"
#include "report/summary.h"
#include "site/choice.h"
#include "site/names.h"
#include "site/technique_facts.h"
#include "site/viewer/cells.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

using report::Tolerance;

Column columnOf(const report::Column& column) {
    const metrics::Metric& line = metrics::table[column.metric.index()];
    const bool own = column.computed != nullptr;
    return {.title = column.title,
            .hint = own ? column.hint : std::string(line.meaning),
            .key = own ? column.key : std::string(line.path),
            .unit = std::string(line.unit),
            .brief = !column.pageOnly,
            .least = own || line.allowance.has_value()};
}

Cell shareCell(const Record& record, const std::vector<Tolerance>& limits) {
    const std::optional<double> share = report::shareOfTolerance(record, limits);
    if (!share) return {"–"};
    return {fmt::format("{:.2f}", *share), *share, {}, *share <= 1 ? "within" : ""};
}

std::vector<std::string> passNames(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> names;
    for (const std::size_t i : report::ofScene(records, scene)) {
        const std::vector<report::TimedFrame> frames = report::timedFrames(records[i]);
        if (frames.empty()) continue;
        for (const auto* passes : {frames.front().passes, &records[i].motionPasses, &records[i].coldPasses})
            for (const PassRecord& pass : *passes)
                if (pass.milliseconds && std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
    }
    return names;
}

Row passRow(const Record& record, const std::vector<PassRecord>& passes, const char* frame,
            const std::vector<std::string>& names, const std::filesystem::path& images) {
    Row row{{techniqueCell(record, images), {}}, {}};
    row.cells[0].text += frame;
    double total = 0;
    for (const std::string& name : names) {
        const auto pass = std::ranges::find(passes, name, &PassRecord::name);
        const bool timed = pass != passes.end() && pass->milliseconds;
        row.cells.push_back(timed ? Cell{fmt::format("{:.2f}", *pass->milliseconds), *pass->milliseconds} : Cell{""});
        total += timed ? *pass->milliseconds : 0;
    }
    row.cells[1] = {fmt::format("{:.2f}", total), total};
    return row;
}

} // namespace

Cell techniqueCell(const Record& record, const std::filesystem::path& images) {
    const std::string title = factsOf(record.technique).title;
    const std::string weakness = report::admittedFailure(record.technique);
    return {.text = record.variant,
            .address = hasCell(record, images) ? cellAddress(record) : "",
            .name = report::nameForPeople(record),
            .note = weakness.empty() ? title : title + "; its weakness: " + weakness};
}

std::vector<std::pair<std::string, std::string>> marksOf(const std::vector<Record>& records, std::size_t index) {
    const Record& record = records[index];
    const TechniqueFacts facts = factsOf(record.technique);
    const std::vector<Tolerance> limits = report::tolerances(records, record.scene);
    return {{"family", facts.family},
            {"answer", facts.answer},
            {"lacks", facts.lacks},
            {"within", report::isWithin(record, limits) ? "yes" : "no"},
            {"baseline", report::isBaseline(record) ? "yes" : "no"},
            {"spread", fmt::format("{}", report::frameCost(record).value_or(report::FrameCost{}).spread)}};
}

Column modelledColumn(const report::Costing& costing) {
    return {.title = "modelled ms",
            .hint = costing.meaning + "; – waits for the program (docs/gpu-cost.md)",
            .key = "modelled",
            .unit = "ms",
            .least = true};
}

Cell modelledCell(const Record& record, const report::Costing& costing) {
    const std::optional<report::FrameCost> cost = costing.of(record);
    return cost ? Cell{fmt::format("{:.3f}", cost->ratio), cost->ratio} : Cell{"–"};
}

Chart costChart(const std::vector<Record>& records, const std::string& scene, const std::string& table) {
    const report::Costing costing = report::shownCosting(records, scene);
    Chart chart{
        .name = fmt::format("{}-{}", report::chartName(costing), slug(scene)),
        .title = fmt::format("Error against cost on {}{}.", truncate(scene), costing.card.empty() ? "" : ", modelled"),
        .text =
            fmt::format("Error against cost of every technique on {}; the figures are in the table below.", truncate(scene)),
        .kind = "scatter",
        .table = table,
        .options = {{"x", costing.card.empty() ? "cost" : "modelled"},
                    {"y", "error"},
                    {"costlabel", "cost: frame time here, as a multiple of sm-uniform's"},
                    {"modelledlabel", costing.meaning}}};
    for (const report::Tolerance& limit : report::tolerances(records, scene))
        if (limit.metric == report::headlineMetric(records, scene))
            chart.options.emplace_back("tolerance", fmt::format("{}", limit.value));
    return chart;
}

Table errorTable(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images) {
    const std::vector<std::size_t> scored = report::scoredOf(records, scene);
    const std::vector<Tolerance> limits = report::tolerances(records, scene);
    const std::string metric = report::headlineMetric(records, scene);
    const report::Costing costing = report::shownCosting(records, scene);
    const bool timed = !report::paretoFront(records, scene, costing.of).empty();
    const bool moves = std::ranges::any_of(scored, [&](std::size_t i) { return report::knowsMotion(records[i]); });
    Table table{.id = "errors",
                .caption = "Every technique on " + scene,
                .columns = {},
                .rows = {},
                .filtered = true,
                .headed = false};
    table.columns = {{.title = "technique", .number = false},
                     {.title = "error",
                      .hint = report::meaning(metric),
                      .key = "error",
                      .unit = report::isShare(metric) ? "share" : "1",
                      .least = true}};
    const bool sampled =
        std::ranges::any_of(scored, [&](std::size_t i) { return report::exactError(records[i]).has_value(); });
    if (sampled)
        table.columns.push_back({.title = "exact",
                                 .hint = "The same against the exact visible share of the light",
                                 .key = "exact",
                                 .least = true});
    if (!limits.empty())
        table.columns.push_back(
            {.title = "× tolerance",
             .hint = "The error that comes nearest to its tolerance, or exceeds it most, as a multiple of it",
             .key = "tolerance",
             .least = true});
    std::vector<const Record*> rows;
    for (const std::size_t i : scored) rows.push_back(&records[i]);
    const std::vector<const report::Column*> chosen = report::applying(report::columns(), rows);
    for (const report::Column* column : chosen) table.columns.push_back(columnOf(*column));
    if (!costing.card.empty()) table.columns.push_back(modelledColumn(costing));
    if (timed)
        table.columns.push_back(
            {.title = "front",
             .hint = "● nothing else has both less error and less cost; ○ the same for a baseline or a large error; ≈ kept "
                     "off the front by the intervals of the costs alone",
             .number = false});
    if (moves)
        table.columns.push_back({.title = "front, standing",
                                 .hint = "The same for scenes where light and casters stand still",
                                 .number = false});

    const Choice choice = choiceFor(records, scene);
    const auto equals = report::inseparable(records, scene);
    for (const std::size_t i : scored) {
        const Record& record = records[i];
        Row row{{techniqueCell(record, images), {errorText(record), headline(record)->value}}, marksOf(records, i)};
        if (record.status == Status::ExpectedFailure) row.cells[0].note += "; fails as the scene expects: " + record.reason;
        if (const std::string doubt = report::unexplainedDoubts(record); !doubt.empty())
            row.cells[0].note += "; doubtful: " + doubt;
        if (equals.contains(i)) row.cells[1].note = "cannot be told from " + report::variantsOf(records, equals.at(i));
        if (choice.take == i) row.cells[0].kind = "take";
        if (sampled) {
            const std::optional<double> exact = report::exactError(record);
            row.cells.push_back(exact ? Cell{report::formatValue(metric, *exact), *exact} : Cell{"–"});
        }
        if (!limits.empty()) row.cells.push_back(shareCell(record, limits));
        for (const report::Column* column : chosen) {
            const std::optional<double> value = column->of(record);
            row.cells.push_back(value ? Cell{column->format(*value), *value} : Cell{"–"});
        }
        if (!costing.card.empty()) row.cells.push_back(modelledCell(record, costing));
        if (timed) {
            Cell front{report::frontMark(records, scene, i, costing.of)};
            if (const std::optional<std::size_t> by = report::keptOffFrontBy(records, scene, i, costing.of)) {
                front.text = "≈";
                front.note =
                    fmt::format("{} errs less, and by the intervals of the costs it may be as cheap", records[*by].variant);
            }
            row.cells.push_back(std::move(front));
        }
        if (moves) row.cells.push_back({report::frontMark(records, scene, i, costing.standing)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table frameTable(const std::vector<Record>& records, const std::string& scene, const FrameList& shown,
                 const std::filesystem::path& images) {
    Table table{.id = shown.id, .caption = shown.caption, .columns = {{.title = "technique", .number = false}}};
    const std::vector<std::size_t> all = report::ofScene(records, scene);
    std::size_t frames = 0;
    for (const std::size_t i : all) frames = std::max(frames, records[i].values.list(shown.list).size());
    for (std::size_t frame = 1; frame <= frames; ++frame)
        table.columns.push_back({.title = std::to_string(frame),
                                 .hint = "frame",
                                 .key = std::to_string(frame),
                                 .unit = report::isShare(shown.metric) ? "share" : "1",
                                 .brief = frame == 1 || frame == frames || frame % 10 == 0});
    for (const std::size_t i : all) {
        const std::vector<double>& values = records[i].values.list(shown.list);
        if (values.empty()) continue;
        Row row{{techniqueCell(records[i], images)}, marksOf(records, i)};
        for (const double value : values) row.cells.push_back({report::formatValue(shown.metric, value), value});
        row.cells.resize(frames + 1, Cell{"–"});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table passTable(const std::vector<Record>& records, const std::string& scene, const std::filesystem::path& images) {
    const std::vector<std::string> names = passNames(records, scene);
    Table table{.id = "passes",
                .caption = "Milliseconds of a frame by pass",
                .columns = {{.title = "technique", .number = false}, {.title = "frame", .key = "total", .unit = "ms"}},
                .rows = {}};
    for (const std::string& name : names)
        table.columns.push_back({.title = name, .key = name, .unit = "ms", .brief = false});
    for (const std::size_t i : report::ofScene(records, scene)) {
        const Record& record = records[i];
        const std::vector<report::TimedFrame> frames = report::timedFrames(record);
        if (frames.empty()) continue;
        const auto add = [&](const std::vector<PassRecord>& passes, const char* frame) {
            table.rows.push_back(passRow(record, passes, frame, names, images));
            table.rows.back().marks = marksOf(records, i);
        };
        add(*frames.front().passes, "");
        if (!record.deviceCosts.empty()) continue; // of the others only the whole frame is timed there
        if (!report::changedPasses(record.motionPasses, record.passes).empty()) add(record.motionPasses, ", in motion");
        if (!report::changedPasses(record.coldPasses, record.passes).empty()) add(record.coldPasses, ", first frame");
    }
    return table;
}

Table unscoredTable(const std::vector<Record>& records, const std::string& scene) {
    Table table{.id = "unscored",
                .caption = "Not scored on " + scene,
                .columns = {{.title = "technique", .number = false},
                            {.title = "status", .number = false},
                            {.title = "why", .number = false, .prose = true}},
                .rows = {}};
    for (const std::size_t i : report::ofScene(records, scene)) {
        const Record& record = records[i];
        if (wasScored(record.status)) continue;
        table.rows.push_back({{{record.variant}, {std::string(name(record.status))}, {record.reason}}, {}});
    }
    return table;
}

} // namespace shadowbench::site
