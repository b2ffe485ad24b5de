#include "harness/report/site/gate_page.h"

#include "base/files.h"
#include "harness/gate/verdict.h"
#include "harness/report/site/gate_site.h"
#include "harness/report/site/made_file.h"
#include "harness/report/site/names.h"
#include "harness/report/site/technique_facts.h"
#include "harness/report/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

std::string directionText(Direction direction) {
    switch (direction) {
    case Direction::Better:
        return "better";
    case Direction::Worse:
        return "worse";
    case Direction::Unclear:
        return "unclear";
    case Direction::Unjudged:
        return "not judged";
    case Direction::Same:
        return "same";
    }
    return "";
}

/// How far the change exceeds what means nothing; a metric that was lost exceeds everything.
double excess(const Change& change) {
    if (!change.base || !change.head) return std::numeric_limits<double>::infinity();
    const double moved = std::abs(*change.head - *change.base);
    return change.allowance > 0 ? moved / change.allowance : moved > 0 ? 1e12 * moved : 0;
}

std::vector<Change> shownChanges(const std::vector<Change>& changes) {
    constexpr Direction order[] = {Direction::Worse, Direction::Unjudged, Direction::Unclear, Direction::Better};
    std::vector<Change> sorted = changes;
    std::erase_if(sorted, [](const Change& change) { return change.direction == Direction::Same; });
    std::ranges::stable_sort(sorted, [&](const Change& a, const Change& b) {
        const auto *const rankA = std::ranges::find(order, a.direction), *const rankB =
                                                                             std::ranges::find(order, b.direction);
        return rankA != rankB ? rankA < rankB : excess(a) > excess(b);
    });
    return sorted;
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
    for (const Change& change : shownChanges(changes)) {
        const TechniqueFacts facts = factsOf(change.variant.substr(0, change.variant.find(':')));
        const double times = excess(change);
        Row row{{Cell{.text = change.variant, .note = change.sentence},
                 Cell{.text = directionText(change.direction),
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

std::string copied(const std::filesystem::path& source, const std::string& to, const SiteWriter& site) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(source, ignored)) return "";
    writeMade(site.folder() / to, readFile(source));
    return to;
}

/// Head, base and truth of each failing cell.
Data pictures(const gate::GateResult& result, const SiteWriter& site) {
    Data cells{Data::type::list};
    for (const gate::FailurePictures& cell : result.pictures) {
        Data list{Data::type::list};
        for (const auto& [who, folder, name] :
             {std::tuple("head", &cell.head, "error"), std::tuple("base", &cell.base, "error"),
              std::tuple("head", &cell.head, "visibility"), std::tuple("base", &cell.base, "visibility"),
              std::tuple("truth", &cell.head, "reference")}) {
            if (folder->empty()) continue;
            const std::string to =
                fmt::format("pictures/gate-{}-{}-{}-{}.png", slug(cell.scene), slug(cell.variant), who, name);
            if (copied(*folder / (std::string(name) + ".png"), to, site).empty()) continue;
            Data entry;
            entry.set("source", to);
            entry.set("caption", fmt::format("{}: {}", who, name));
            list << entry;
        }
        Data data;
        data.set("cell", fmt::format("{} on {}", shown(cell.variant), shown(cell.scene)));
        data.set("pictures", list);
        cells << data;
    }
    return cells;
}

Data sentences(const std::vector<std::string>& lines) {
    Data list{Data::type::list};
    for (const std::string& line : lines) {
        Data entry;
        entry.set("sentence", shown(line, sentenceRoom));
        list << entry;
    }
    return list;
}

} // namespace

void addGatePage(const gate::GateResult& result, const gate::GateOptions& options, SiteWriter& site) {
    const auto count = [&](Direction direction) {
        return std::ranges::count(result.changes, direction, &Change::direction);
    };
    Data data;
    data.set("verdict", verdictText(result.code()));
    data.set("kind", result.code() == ExitCode::Pass           ? "reproduced"
                     : result.code() == ExitCode::Inconclusive ? "unmeasured"
                                                               : "refuted");
    data.set("head", shown(result.head));
    data.set("base", shown(result.base));
    data.set("counts", fmt::format("{} figures are worse, {} not judged, {} unclear, {} better, {} the same.",
                                   count(Direction::Worse), count(Direction::Unjudged), count(Direction::Unclear),
                                   count(Direction::Better), count(Direction::Same)));
    data.set("table", site.table(address, changeTable(result.changes, options)));
    data.set("cells", pictures(result, site));
    data.set("unjudged", sentences(result.unjudged));
    data.set("notes", sentences(result.notes));
    site.add({address, verdictText(result.code()), render("gate.html", data)});
}

gate::GateResult comparedWith(const std::vector<Record>& base, const std::vector<Record>& head) {
    gate::GateResult result;
    const auto nameOf = [](const std::vector<Record>& records) {
        return records.empty() ? std::string("no records") : records.front().commit;
    };
    result.base = nameOf(base);
    result.head = nameOf(head);
    result.changes = gate::compare(base, head);
    if (const auto why = gate::whyMeaningless(base, head, false)) result.unjudged.push_back(*why);
    return result;
}

std::filesystem::path writeGateSite(const gate::GateResult& result, const gate::GateOptions& options) {
    SiteWriter site(options.out, {{"Gate", address}});
    addGatePage(result, options, site);
    site.writeAssets();
    return options.out / address;
}

} // namespace shadowbench::site
