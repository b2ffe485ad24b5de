// Tables of one scene, for a terminal and in Markdown.
#include "harness/report/run_report.h"
#include "harness/report/summary.h"
#include "harness/report/text_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace shadowbench::report {
namespace {

using Cell = std::optional<std::string>; // nothing: does not apply

struct Column {
    const char* title;
    bool pageOnly; // the terminal has no room for it
    Cell (*cell)(const Record&);
};

Cell percentOf(const std::optional<double>& share) { return share ? Cell(percent(*share)) : Cell(); }

Cell decimals(const std::optional<double>& value, int places) {
    return value ? Cell(fmt::format("{:.{}f}", *value, places)) : Cell();
}

Cell error(const Record& r) {
    const std::optional<Headline> head = headline(r);
    return head ? Cell(shown(head->metric, head->value)) : Cell();
}

Cell edge(const Record& r) { return r.accuracy.edgeError ? decimals(r.accuracy.edgeError->mean, 2) : Cell(); }
Cell flickerMean(const Record& r) { return r.stability.flicker ? decimals(r.stability.flicker->mean, 3) : Cell(); }
Cell convergence(const Record& r) {
    return r.stability.convergence ? Cell(std::to_string(*r.stability.convergence)) : Cell();
}
Cell cost(const Record& r) { return r.cost.time ? decimals(r.cost.time->ratio, 2) : Cell(); }

Cell mebibytes(const Record& r) {
    if (!r.cost.work) return {};
    return decimals(static_cast<double>(r.cost.work->bytes) / (1024.0 * 1024.0), 1);
}

std::span<const Column> columns() {
    static constexpr Column all[] = {
        {"error", false, error},
        {"false shadow", false, [](const Record& r) { return percentOf(r.accuracy.falseShadow); }},
        {"leak", false, [](const Record& r) { return percentOf(r.accuracy.leak); }},
        {"edge error px", false, edge},
        {"off-edge error", true, [](const Record& r) { return percentOf(r.accuracy.mismatchOffEdge); }},
        {"bad30", true, [](const Record& r) { return percentOf(r.accuracy.bad30); }},
        {"SSIM", true, [](const Record& r) { return decimals(r.accuracy.ssim, 3); }},
        {"penumbra rmse", true, [](const Record& r) { return decimals(r.accuracy.penumbraRmse, 4); }},
        {"penumbra width", true, [](const Record& r) { return percentOf(r.accuracy.penumbraWidthError); }},
        {"umbra leak", true, [](const Record& r) { return decimals(r.accuracy.umbraLeak, 4); }},
        {"texel px", true, [](const Record& r) { return r.aliasing ? decimals(r.aliasing->median, 2) : Cell(); }},
        {"texel px p95", true, [](const Record& r) { return r.aliasing ? decimals(r.aliasing->p95, 2) : Cell(); }},
        {"flicker", false, flickerMean},
        {"flips", true, [](const Record& r) { return percentOf(r.stability.flipRate); }},
        {"moving rmse", true, [](const Record& r) { return decimals(r.stability.movingRmse, 4); }},
        {"converged at", true, convergence},
        {"MiB", true, mebibytes},
        {"cost", false, cost},
    };
    return all;
}

std::string rowName(const Record& record) {
    return record.status == Status::ExpectedFailure ? record.variant + " (fails as expected)" : record.variant;
}

/// Scored records of `scene`, with the columns that apply to at least one of them.
TextTable table(const std::vector<Record>& records, const std::string& scene, bool page) {
    std::vector<std::size_t> scored;
    for (const std::size_t i : ofScene(records, scene))
        if (headline(records[i])) scored.push_back(i);

    TextTable result{{"technique"}, {}};
    for (const std::size_t i : scored) result.rows.push_back({rowName(records[i])});
    for (const Column& column : columns()) {
        const auto applies = [&](std::size_t i) { return column.cell(records[i]).has_value(); };
        if ((column.pageOnly && !page) || std::none_of(scored.begin(), scored.end(), applies)) continue;
        result.titles.emplace_back(column.title);
        for (std::size_t row = 0; row < scored.size(); ++row)
            result.rows[row].push_back(column.cell(records[scored[row]]).value_or("–"));
    }
    const std::vector<std::size_t> front = paretoFront(records, scene);
    if (front.empty()) return result;
    result.titles.emplace_back("front");
    for (std::size_t row = 0; row < scored.size(); ++row)
        result.rows[row].emplace_back(std::find(front.begin(), front.end(), scored[row]) == front.end() ? "" : "●");
    return result;
}

std::vector<std::string> footnotes(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::string> lines;
    if (const std::optional<Tolerance> limit = tolerance(records, scene)) {
        const std::optional<std::size_t> best = cheapestAdequate(records, scene);
        const std::string metric = limit->metric == headlineMetric(records, scene) ? "" : limit->metric + " ";
        const std::string bound = metric + shownBound(*limit);
        std::vector<std::string_view> within;
        for (const std::size_t i : adequate(records, scene)) within.push_back(records[i].variant);
        lines.push_back(best ? fmt::format("cheapest within tolerance ({}): {}", bound, records[*best].variant)
                        : within.empty()
                            ? fmt::format("no technique is within tolerance ({})", bound)
                            : fmt::format("within tolerance ({}), none of them timed: {}", bound, fmt::join(within, ", ")));
    }
    std::vector<std::pair<std::string, std::string>> inapplicable; // reason → variants, in order of first occurrence
    for (const std::size_t i : ofScene(records, scene)) {
        const Record& record = records[i];
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
    if (!metric.empty()) line += fmt::format(" · error = {} · cost = frames of sm-uniform", meaning(metric));
    return line;
}

} // namespace

std::string terminalTable(const std::vector<Record>& records, const std::string& scene) {
    if (ofScene(records, scene).empty()) return "";
    const TextTable content = table(records, scene, false);
    std::string text = fmt::format(" {}\n", heading(records, scene));
    if (!content.rows.empty()) text += aligned(content);
    for (const std::string& line : footnotes(records, scene)) text += fmt::format(" {}\n", line);
    return text;
}

std::string markdownTable(const std::vector<Record>& records, const std::string& scene) {
    std::string text = markdown(table(records, scene, true));
    for (const std::string& line : footnotes(records, scene)) text += fmt::format("\n{}\n", markdownText(line));
    for (const std::string& line : figureLines(records, scene)) text += fmt::format("\n{}\n", markdownText(line));
    return text;
}

} // namespace shadowbench::report
