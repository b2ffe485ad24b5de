#include "site/gate_page.h"

#include "gate/verdict.h"
#include "report/summary.h"
#include "site/gate_site.h"
#include "site/names.h"
#include "site/technique_facts.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace shadowbench::site {
namespace {

using gate::Change;
using gate::Direction;

constexpr const char* address = "gate.html";

std::string verdictText(ExitCode code) {
    switch (code) {
    case ExitCode::Pass:
        return "Nothing is worse";
    case ExitCode::CostRegression:
        return "Cost is worse";
    case ExitCode::AccuracyRegression:
        return "Accuracy or stability is worse";
    default:
        return "Inconclusive";
    }
}

Cell valueCell(const Change& change, const std::optional<double>& value) {
    if (!value) return {"none"};
    const metrics::Metric* line = metrics::metricAt(change.metric);
    const bool share = line != nullptr && line->unit == "share";
    return {share ? report::percent(*value) : fmt::format("{:.5g}", *value), *value};
}

Table changeTable(const std::vector<Change>& changes, const gate::GateOptions& options) {
    Table table{.id = "changes", .caption = "What changed, the worst first", .rows = {}, .filtered = true, .headed = false};
    table.columns = {
        {.title = "technique", .number = false},
        {.title = "is", .number = false},
        {.title = "scene", .number = false},
        {.title = "metric", .number = false},
        {.title = "base"},
        {.title = "head"},
        {.title = "allowed", .hint = "So much of a change may be the truth's own error, a stray pixel or noise"},
        {.title = "× allowed", .hint = "The change as a multiple of what is allowed"},
        {.title = "to see it again", .number = false, .brief = false, .prose = true}};
    for (const Change& change : gate::worstFirst(changes)) {
        const TechniqueFacts facts = factsOf(techniques::idOfVariant(change.variant));
        const double times = gate::excess(change);
        Row row{{Cell{.text = change.variant, .note = change.sentence},
                 Cell{.text = std::string(gate::name(change.direction)),
                      .kind = change.direction == Direction::Worse    ? "refuted"
                              : change.direction == Direction::Better ? "reproduced"
                                                                      : "unmeasured"},
                 Cell{change.scene}, Cell{.text = change.metric, .note = std::string(gate::name(change.changeClass))},
                 valueCell(change, change.base), valueCell(change, change.head),
                 Cell{fmt::format("{:.3g}", change.allowance), change.allowance},
                 change.allowance > 0 && std::isfinite(times) ? Cell{fmt::format("{:.1f}", times), times} : Cell{"–"},
                 Cell{.text = gate::reproduction(change, options), .kind = "code"}},
                {{"family", facts.family},
                 {"answer", facts.answer},
                 {"within", change.direction == Direction::Worse ? "no" : "yes"},
                 {"baseline", "no"}}};
        table.rows.push_back(std::move(row));
    }
    return table;
}

Data pictureData(const std::string& source, const std::string& caption, const std::string& cell) {
    Data data;
    data.set("source", source);
    data.set("caption", caption);
    data.set("text", fmt::format("{}: {}", cell, caption));
    return data;
}

/// What head and base show of a cell, the truth, and where each is wrong; nothing where that cannot be shown.
std::optional<Data> pictures(const ComparedCell& cell, const std::string& title, const SiteWriter& site) {
    const auto head = cellPictures(cell.head, cell.head.images, site);
    const auto base = cell.base ? cellPictures(*cell.base, cell.head.images, site) : std::nullopt;
    if (!head) return std::nullopt;
    Data list{Data::type::list};
    list << pictureData(head->difference, "head: orange too dark, blue too bright", title);
    if (base) list << pictureData(base->difference, "base: the same", title);
    list << pictureData(head->technique, "head", title);
    if (base) list << pictureData(base->technique, "base", title);
    list << pictureData(head->truth, "truth", title);
    return list;
}

/// The worst of each result and cause, ten at most; the first of a cell that was drawn has its pictures.
Data worstOf(const std::vector<Change>& changes, const std::vector<ComparedCell>& cells, const SiteWriter& site) {
    constexpr std::size_t most = 10;
    std::vector<Change> worst = gate::oneACause(gate::worstFirst(changes));
    std::erase_if(worst, [](const Change& change) { return change.direction == Direction::Better; });
    worst.resize(std::min(worst.size(), most));
    std::set<const ComparedCell*> shownCells;
    Data list{Data::type::list};
    for (const Change& change : worst) {
        Data data;
        data.set("is", std::string(gate::name(change.direction)));
        data.set("sentence", truncate(change.sentence, sentenceRoom));
        const auto cell = std::ranges::find_if(cells, [&](const ComparedCell& c) {
            return c.head.record.scene == change.scene && c.head.record.variant == change.variant;
        });
        if (cell != cells.end() && shownCells.insert(&*cell).second) {
            const std::string title = fmt::format("{} on {}", truncate(change.variant), truncate(change.scene));
            if (const std::optional<Data> shownPictures = pictures(*cell, title, site)) {
                data.set("to", cellAddress(cell->head, cell->base ? &*cell->base : nullptr));
                data.set("pictures", *shownPictures);
            }
        }
        list << data;
    }
    return list;
}

Table classTable(const std::vector<Change>& changes) {
    constexpr std::array directions{Direction::Worse,  Direction::NotCompared, Direction::Unclear,
                                    Direction::Waived, Direction::Better,      Direction::Same};
    std::map<gate::Class, std::map<Direction, int>> counts;
    for (const Change& change : changes) ++counts[change.changeClass][change.direction];
    Table table{.id = "classes", .caption = "By class", .columns = {{.title = "class", .number = false}}, .rows = {}};
    for (const Direction direction : directions) table.columns.push_back({.title = std::string(gate::name(direction))});
    for (auto& [changeClass, byDirection] : counts) {
        Row& row = table.rows.emplace_back(Row{{Cell{std::string(gate::name(changeClass))}}});
        for (const Direction direction : directions)
            row.cells.push_back({fmt::format("{}", byDirection[direction]), static_cast<double>(byDirection[direction])});
    }
    return table;
}

/// The cells that a gate has drawn again.
std::vector<ComparedCell> drawnCells(const gate::GateResult& result) {
    const auto imagesOf = [](const std::filesystem::path& cell) { return cell.parent_path().parent_path(); };
    std::vector<ComparedCell> cells;
    for (const gate::FailurePictures& drawn : result.pictures) {
        if (!drawn.headRecord) continue;
        ComparedCell& cell = cells.emplace_back(
            ComparedCell{{"head:" + drawn.variant, *drawn.headRecord, imagesOf(drawn.head), true}, std::nullopt});
        if (drawn.baseRecord) cell.base = RunCell{"base:" + drawn.variant, *drawn.baseRecord, imagesOf(drawn.base), true};
    }
    return cells;
}

/// A page for each scene, with the cells of both sides.
void writeCellPages(const std::vector<ComparedCell>& cells, SiteWriter& site) {
    std::map<std::string, std::vector<RunCell>> ofScenes;
    for (const ComparedCell& cell : cells) {
        std::vector<RunCell>& ofScene = ofScenes[cell.head.record.scene];
        ofScene.push_back(cell.head);
        if (cell.base) ofScene.push_back(*cell.base);
    }
    bool any = false;
    for (const auto& [scene, ofScene] : ofScenes) any = writeCellPage(ofScene, {"What is worse", address}, site) || any;
    if (any) writeViewer(site);
}

Data sentences(const std::vector<std::string>& lines) {
    Data list{Data::type::list};
    for (const std::string& line : lines) {
        Data entry;
        entry.set("sentence", truncate(line, sentenceRoom));
        list << entry;
    }
    return list;
}

Data logsOf(const std::vector<gate::FailureLog>& logs) {
    Data list{Data::type::list};
    for (const gate::FailureLog& log : logs) {
        Data entry, lines{Data::type::list};
        for (const std::string& text : log.lines) {
            Data line;
            line.set("line", text);
            lines << line;
        }
        entry.set("what", truncate(log.what, sentenceRoom));
        entry.set("file", log.file.string());
        entry.set("lines", lines);
        list << entry;
    }
    return list;
}

} // namespace

void addGatePage(const gate::GateResult& result, const gate::GateOptions& options, const std::vector<ComparedCell>& cells,
                 SiteWriter& site) {
    const auto count = [&](Direction direction) {
        return std::ranges::count(result.changes, direction, &Change::direction);
    };
    Data data;
    data.set("verdict", verdictText(result.code()));
    data.set("kind", result.code() == ExitCode::Pass           ? "reproduced"
                     : result.code() == ExitCode::Inconclusive ? "unmeasured"
                                                               : "refuted");
    data.set("head", truncate(result.head));
    data.set("base", truncate(result.base));
    data.set("counts",
             fmt::format("{} figures are worse, {} not compared, {} unclear, {} waived, {} better, {} the same; {}.",
                         count(Direction::Worse), count(Direction::NotCompared), count(Direction::Unclear),
                         count(Direction::Waived), count(Direction::Better), count(Direction::Same),
                         truncate(gate::text(result.presence), sentenceRoom)));
    data.set("table", site.table(address, changeTable(result.changes, options)));
    data.set("classes", site.table(address, classTable(result.changes)));
    data.set("worst", worstOf(result.changes, cells, site));
    data.set("loosened", sentences(result.loosened));
    data.set("notCompared", sentences(result.notCompared));
    data.set("notes", sentences(result.notes));
    data.set("logs", logsOf(result.logs));
    site.add({address, verdictText(result.code()), render("gate.html", data)});
}

std::vector<ComparedCell> worseCells(const std::vector<Change>& changes, const RunImages& base, const RunImages& head) {
    constexpr std::size_t most = 12;
    const auto find = [](const RunImages& run, const Change& change) {
        return std::ranges::find_if(run.records, [&](const Record& record) {
            return record.scene == change.scene && record.variant == change.variant && !record.sweep;
        });
    };
    std::vector<ComparedCell> cells;
    for (const Change& change : gate::worstFirst(changes)) {
        const auto now = find(head, change), before = find(base, change);
        const bool known = std::ranges::any_of(cells, [&](const ComparedCell& cell) {
            return cell.head.record.scene == change.scene && cell.head.record.variant == change.variant;
        });
        if (change.direction != Direction::Worse || known || cells.size() == most) continue;
        if (now == head.records.end() || !hasCell(*now, head.images)) continue;
        ComparedCell& cell = cells.emplace_back(ComparedCell{{now->variant, *now, head.images}, std::nullopt});
        if (before != base.records.end() && hasCell(*before, base.images))
            cell.base = RunCell{"base:" + before->variant, *before, base.images};
    }
    return cells;
}

std::filesystem::path writeGateSite(const gate::GateResult& result, const gate::GateOptions& options) {
    SiteWriter site(options.out, {{"Gate", address}});
    const std::vector<ComparedCell> cells = drawnCells(result);
    writeCellPages(cells, site);
    addGatePage(result, options, cells, site);
    site.writeAssets();
    return options.out / address;
}

} // namespace shadowbench::site
