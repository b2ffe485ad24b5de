#include "report/terminal_summary.h"

#include "report/advice.h"
#include "report/costing.h"
#include "report/run_report.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr std::size_t untimedRows = 5;

std::vector<std::size_t> scored(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::size_t> indices = ofScene(records, scene);
    std::erase_if(indices, [&](std::size_t i) { return !headline(records[i]); });
    return indices;
}

std::vector<std::size_t> leastErrors(const std::vector<Record>& records, std::vector<std::size_t> indices) {
    std::ranges::stable_sort(indices, {}, [&](std::size_t i) { return headline(records[i])->value; });
    indices.resize(std::min(indices.size(), untimedRows));
    return indices;
}

std::vector<std::size_t> frontAndCheapest(const std::vector<Record>& records, const std::string& scene) {
    const CostOf costOf = shownCosting(records, scene).of;
    std::vector<std::size_t> rows = paretoFront(records, scene, costOf);
    const std::optional<std::size_t> cheapest = adviceFor(records, scene).take;
    if (!cheapest || std::ranges::find(rows, *cheapest) != rows.end()) return rows;
    const auto dearer = [&](std::size_t i) {
        return place(records[i], costOf)->cost > place(records[*cheapest], costOf)->cost;
    };
    rows.insert(std::ranges::find_if(rows, dearer), *cheapest);
    return rows;
}

/// Adds other renderers' rows, which are never on the front, and says whether there are any.
bool addExternal(const std::vector<Record>& records, const std::vector<std::size_t>& all, std::vector<std::size_t>& rows) {
    const std::size_t before = rows.size();
    for (const std::size_t i : all)
        if (isExternal(records[i]) && std::ranges::find(rows, i) == rows.end()) rows.push_back(i);
    return rows.size() > before;
}

/// "not applicable: 4, errors: 1"; "" if all are scored.
std::string unscoredOf(const std::vector<Record>& records, const std::string& scene) {
    std::size_t inapplicable = 0, errors = 0;
    for (const std::size_t i : ofScene(records, scene)) {
        if (records[i].status == Status::NotApplicable) ++inapplicable;
        if (records[i].status == Status::Error) ++errors;
    }
    std::string text;
    if (inapplicable > 0) text += fmt::format("; not applicable: {}", inapplicable);
    if (errors > 0) text += fmt::format("; errors: {}", errors);
    return text;
}

} // namespace

std::string terminalSummary(const std::vector<Record>& records, const std::string& scene, const std::string& page,
                            Rows shown) {
    const std::vector<std::size_t> all = scored(records, scene);
    const std::string unscored = unscoredOf(records, scene);
    if (all.empty() && unscored.empty()) return "";
    if (shown == Rows::All) return terminalTable(records, scene);
    if (all.empty()) return fmt::format(" {}: no technique is scored{}\n", scene, unscored);
    std::vector<std::size_t> rows = frontAndCheapest(records, scene);
    const bool timed = !rows.empty();
    if (!timed) rows = leastErrors(records, all);
    const std::string others = addExternal(records, all, rows) ? " and other renderers" : "";
    std::string text = terminalTable(records, scene, rows);
    const std::string which = (timed ? "Pareto front" : "least errors") + others;
    text += fmt::format(" {}: {} of {} techniques{}; the full table: {}\n", which, rows.size(), all.size(), unscored, page);
    return text;
}

} // namespace shadowbench::report
