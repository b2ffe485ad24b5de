// Tables of one scene, for a terminal and in Markdown.
#include "report/advice.h"
#include "report/columns.h"
#include "report/cost_report.h"
#include "report/costing.h"
#include "report/doubts.h"
#include "report/run_report.h"
#include "report/summary.h"
#include "report/text_table.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <string_view>

namespace shadowbench::report {
namespace {

std::string rowName(const Record& record, const std::string& name) {
    if (!unexplainedDoubts(record).empty()) return name + " (doubtful)";
    return record.status == Status::ExpectedFailure ? name + " (fails as expected)" : name;
}

/// The columns that decide beside name, error and front: what is wrong, whether it flickers, what a frame costs.
std::vector<Column> decidingColumns(bool soft) {
    static constexpr std::string_view ofLabels[] = {"false shadow", "leak", "edge error px", "flicker", "cost"};
    static constexpr std::string_view ofShares[] = {"penumbra rmse", "umbra leak", "flicker", "cost"};
    std::vector<Column> chosen;
    for (const Column& column : columns())
        if (const std::span<const std::string_view> wanted = soft ? std::span<const std::string_view>(ofShares) : ofLabels;
            std::ranges::find(wanted, column.title) != wanted.end())
            chosen.push_back(column);
    return chosen;
}

/// Scored records of `scene`, with the columns that apply to at least one of them: of a terminal's table by their variants,
/// of a page's by names, variants in small print.
TextTable table(const std::vector<Record>& records, const std::string& scene, bool page) {
    const std::vector<std::size_t> scored = scoredOf(records, scene);
    TextTable result{{"technique"}, {}};
    if (!scored.empty()) result.titles.emplace_back("error");
    for (const std::size_t i : scored) {
        const Record& record = records[i];
        const std::string name = page ? nameForPeople(record) : record.variant;
        result.rows.push_back({rowName(record, name), errorText(record)});
        if (page) result.small.push_back(name == record.variant ? "" : record.variant);
    }
    if (std::ranges::any_of(scored, [&](std::size_t i) { return exactError(records[i]).has_value(); })) {
        result.titles.emplace_back("exact");
        for (std::size_t row = 0; row < scored.size(); ++row) {
            const Record& record = records[scored[row]];
            const std::optional<double> value = exactError(record); // against the exact visible share
            result.rows[row].push_back(value ? formatValue(headline(record)->metric, *value) : "–");
        }
    }
    std::vector<const Record*> rows;
    for (const std::size_t i : scored) rows.push_back(&records[i]);
    addColumns(result,
               page ? decidingColumns(headlineMetric(records, scene) == "rmse")
                    : std::vector<Column>(columns().begin(), columns().end()),
               rows, page);
    const Costing costing = shownCosting(records, scene);
    if (paretoFront(records, scene, costing.of).empty()) return result;
    if (!costing.card.empty()) {
        result.titles.emplace_back("modelled ms");
        for (std::size_t row = 0; row < scored.size(); ++row) {
            const std::optional<FrameCost> cost = costing.of(records[scored[row]]);
            result.rows[row].push_back(cost ? fmt::format("{:.3f}", cost->ratio) : "–");
        }
    }
    result.titles.emplace_back("front");
    for (std::size_t row = 0; row < scored.size(); ++row)
        result.rows[row].emplace_back(frontMark(records, scene, scored[row], costing.of));
    return result;
}

/// "planar-hard (Projected shadow on a plane; its weakness: Shades nothing but its plane)": what does here may not do
/// elsewhere.
std::string withTitle(const Record& record) {
    if (record.external && !record.external->title.empty())
        return fmt::format("{} ({})", record.variant, record.external->title);
    const auto all = techniques::catalog();
    const auto entry = std::ranges::find(all, record.technique, &techniques::Entry::id);
    if (entry == all.end()) return record.variant;
    const std::string failure = admittedFailure(record.technique);
    return fmt::format("{} ({}{}{})", record.variant, entry->title, failure.empty() ? "" : "; its weakness: ", failure);
}

/// "truth: exact (polygon+rays), exact (pixel-areas); σ 0.0006": what errors cannot resolve.
std::string truthLine(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> truths;
    for (const std::size_t i : ofScene(records, scene))
        for (const auto* info : {&records[i].reference, &records[i].softReference, &records[i].pixelReference}) {
            if (!*info) continue;
            const std::string text = truth(**info);
            if (std::ranges::find(truths, text) == truths.end()) truths.push_back(text);
        }
    return truths.empty() ? "" : fmt::format("truth: {}", fmt::join(truths, "; "));
}

/// "saved while light and casters stand still: sm-adaptive 2.54 ×"; whose cost in motion is not known.
std::vector<std::string> motionLines(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> kept, unknown;
    bool known = false;
    for (const std::size_t i : ofScene(records, scene)) {
        if (const std::optional<double> saved = cacheSaves(records[i]))
            kept.push_back(fmt::format("{} {:.2f} ×", records[i].variant, *saved));
        known = known || knowsMotion(records[i]);
        if (place(records[i]) && !knowsMotion(records[i])) unknown.push_back(records[i].variant);
    }
    std::vector<std::string> lines;
    if (!kept.empty()) lines.push_back(fmt::format("saved while light and casters stand still: {}", fmt::join(kept, ", ")));
    if (known && !unknown.empty())
        lines.push_back(fmt::format("cost of the standing frame alone: {}", fmt::join(unknown, ", ")));
    return lines;
}

/// What to take, and what else would do here.
std::vector<std::string> adviceLines(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> lines;
    if (scoredOf(records, scene).empty()) return lines;
    if (const std::vector<Tolerance> limits = tolerances(records, scene); !limits.empty()) {
        const Advice advice = adviceFor(records, scene);
        const bool ofError = limits.size() == 1 && limits.front().metric == headlineMetric(records, scene);
        const std::string bound = ofError ? formatBound(limits.front()) : formatBounds(limits);
        const bool none = advice.within.empty() && advice.unsuited.empty() && advice.external.empty();
        lines.push_back(
            advice.take ? fmt::format("cheapest within tolerance ({}): {}", bound, withTitle(records[*advice.take]))
            : none      ? fmt::format("no technique is within tolerance ({})", bound)
            : advice.within.empty()
                ? fmt::format("tolerance: {}", bound)
                : fmt::format("within tolerance ({}), none of them timed: {}", bound, variantsOf(records, advice.within)));
        for (std::string& note : notesOn(advice, records, techniques::usualNeeds())) lines.push_back(std::move(note));
    }
    return lines;
}

/// Of the scene's records `all`, and of those that the table has rows of.
std::vector<std::string> footnotes(const std::vector<Record>& all, const std::vector<Record>& records,
                                   const std::string& scene) {
    std::vector<std::string> lines = adviceLines(all, scene);
    if (const std::string line = truthLine(records, scene); !line.empty()) lines.insert(lines.begin(), line);
    std::vector<std::string> kept;
    const Costing costing = shownCosting(records, scene);
    if (!costing.card.empty()) lines.push_back(fmt::format("modelled ms: {}; – waits for the program", costing.meaning));
    for (const std::size_t i : ofScene(records, scene))
        if (const std::optional<std::size_t> by = keptOffFrontBy(records, scene, i, costing.of))
            kept.push_back(fmt::format("{} (by {})", records[i].variant, records[*by].variant));
    if (!kept.empty())
        lines.push_back(fmt::format(
            "off the front by the intervals of the costs (what is in brackets errs less and may be as cheap): {}",
            fmt::join(kept, ", ")));
    for (std::string& line : motionLines(records, scene)) lines.push_back(std::move(line));
    for (const auto& [row, others] : inseparable(records, scene))
        for (const std::size_t other : others)
            if (row < other)
                lines.push_back(fmt::format("cannot be told apart: {} and {} (samples of the light order them one way, the "
                                            "exact share the other)",
                                            records[row].variant, records[other].variant));
    if (const std::string reported = reportedCosts(records, scene); !reported.empty())
        lines.push_back("time of a frame as the renderers themselves report it, not measured here: " + reported);
    std::vector<std::pair<std::string, std::string>> inapplicable; // reason → variants, in order of first occurrence
    for (const std::size_t i : ofScene(records, scene)) {
        const Record& record = records[i];
        if (const std::string doubt = unexplainedDoubts(record); !doubt.empty())
            lines.push_back(fmt::format("doubtful: {} ({})", record.variant, doubt));
        if (record.status == Status::Error) lines.push_back(fmt::format("error: {} ({})", record.variant, record.reason));
        if (record.status != Status::NotApplicable) continue;
        const auto same = std::find_if(inapplicable.begin(), inapplicable.end(),
                                       [&](const auto& known) { return known.first == record.reason; });
        if (same == inapplicable.end())
            inapplicable.emplace_back(record.reason, record.variant);
        else
            same->second += ", " + record.variant;
    }
    for (const auto& [reason, variants] : inapplicable)
        lines.push_back(fmt::format("not applicable: {} ({})", variants, reason));
    return lines;
}

/// "external:three-pcf: three.js PCF 1024² (three.js r160)".
std::vector<std::string> rendererLines(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> lines;
    for (const std::size_t i : ofScene(records, scene)) {
        if (!records[i].external) continue;
        const auto& [title, source, reported, revision] = *records[i].external;
        const std::string by = source.empty() ? "" : title.empty() ? source : fmt::format(" ({})", source);
        if (!title.empty() || !by.empty()) lines.push_back(fmt::format("{}: {}{}", records[i].variant, title, by));
    }
    return lines;
}

/// "figures of volume-zpass: stencil_bytes 2.41e+06, stencil_updates 8.12e+04".
std::vector<std::string> figureLines(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> lines;
    for (const std::size_t i : ofScene(records, scene)) {
        if (records[i].figures.empty()) continue;
        std::vector<std::string> figures;
        for (const auto& [name, value] : records[i].figures) figures.push_back(fmt::format("{} {:.3g}", name, value));
        lines.push_back(fmt::format("figures of {}: {}", records[i].variant, fmt::join(figures, ", ")));
    }
    return lines;
}

std::string heading(const std::vector<Record>& records, const std::string& scene) {
    const Record& first = records[ofScene(records, scene).front()];
    std::string line = fmt::format("scene: {} · {}", scene, imageSize(first));
    const std::string metric = headlineMetric(records, scene);
    if (!metric.empty()) line += fmt::format(" · error = {} · cost = {}", meaning(metric), costMeaning(records, scene));
    return line;
}

} // namespace

std::string terminalTable(const std::vector<Record>& records, const std::string& scene,
                          const std::vector<std::size_t>& rows) {
    if (rows.empty()) return "";
    std::vector<Record> shown;
    for (const std::size_t i : rows) shown.push_back(records[i]);
    const TextTable content = table(shown, scene, false);
    std::string text = fmt::format(" {}\n", heading(records, scene));
    if (!content.rows.empty()) text += aligned(content);
    for (const std::string& line : footnotes(records, shown, scene)) text += fmt::format(" {}\n", line);
    return text;
}

std::string terminalTable(const std::vector<Record>& records, const std::string& scene) {
    return terminalTable(records, scene, ofScene(records, scene));
}

std::string markdownTable(const std::vector<Record>& records, const std::string& scene) {
    std::string text = markdown(table(records, scene, true));
    for (const std::string& line : footnotes(records, records, scene)) text += fmt::format("\n{}\n", markdownText(line));
    if (const std::string note = rasteriserNote(records, scene); !note.empty()) text += fmt::format("\n{}\n", note);
    for (const std::string& line : rendererLines(records, scene)) text += fmt::format("\n{}\n", markdownText(line));
    for (const std::string& line : figureLines(records, scene)) text += fmt::format("\n{}\n", markdownText(line));
    return text;
}

} // namespace shadowbench::report
