// The table of what each technique is good at and where it fails, in Markdown and LaTeX.
#include "harness/metrics/table.h"
#include "report/summary.h"
#include "report/text_table.h"
#include "scene/scene.h"
#include "studies/behaviour/behaviour.h"
#include "studies/claims/claims.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace {

/// "accuracy.by_frame.rmse[2]" → "rmse[2]"; "cost.time.ratio" → "time.ratio".
std::string shortName(const std::string& metric) {
    const std::string_view path = metric;
    for (const std::string_view group :
         {"accuracy.", "stability.by_frame.", "stability.", "cost.work.", "cost.", "figures."})
        if (path.starts_with(group)) return std::string(path.substr(group.size()));
    return metric;
}

bool isShare(const std::string& metric) {
    const std::string path = metric.substr(0, metric.find('['));
    const auto line = std::ranges::find(metrics::table, std::string_view(path), &metrics::Metric::path);
    return line != metrics::table.end() && line->unit == "share";
}

std::string valueOf(const Asserted& asserted, const std::vector<Record>& records) {
    Figure figure;
    figure.scene = asserted.scene;
    figure.variant = asserted.variant;
    figure.profile = name(Profile::Gate);
    figure.metric = asserted.metric;
    const std::optional<double> value = lookUp(figure, records);
    if (!value) return "–";
    if (isShare(asserted.metric)) return report::percent(*value);
    return *value >= 1e4 ? fmt::format("{:.0f}", *value) : fmt::format("{:.3g}", *value);
}

std::string sourceOf(const std::string& technique) {
    const auto catalog = techniques::catalog();
    const auto entry = std::ranges::find(catalog, technique, &techniques::Entry::id);
    return entry == catalog.end() ? "–" : citation(entry->source);
}

report::TextTable table(const std::vector<Behaviour>& behaviours, const std::vector<Record>& records) {
    report::TextTable result{
        {"technique", "source", "strength", "test", "scene", "figure", "failure", "test", "scene", "figure"}, {}};
    for (const Behaviour& behaviour : behaviours) {
        std::vector<std::string> row{behaviour.technique, sourceOf(behaviour.technique)};
        for (const Asserted* asserted : {&behaviour.strength, &behaviour.failure})
            for (std::string& cell : cellsOf(behaviour.technique, *asserted, records)) row.push_back(std::move(cell));
        result.rows.push_back(std::move(row));
    }
    return result;
}

/// Text with LaTeX's own characters escaped. Long names may break where they have a dot, a colon, a comma or a new word.
std::string latexText(const std::string& text) {
    std::string result;
    bool lower = false;
    for (const char c : text) {
        if (lower && c >= 'A' && c <= 'Z') result += "\\allowbreak{}";
        lower = c >= 'a' && c <= 'z';
        switch (c) {
        case '\\':
            result += "\\textbackslash{}";
            break;
        case '~':
            result += "\\textasciitilde{}";
            break;
        case '^':
            result += "\\textasciicircum{}";
            break;
        case '<':
            result += "$<$";
            break;
        case '&':
        case '%':
        case '$':
        case '#':
        case '_':
        case '{':
        case '}':
            result += '\\';
            [[fallthrough]];
        default:
            result += c;
        }
        if (c == '.' || c == ':' || c == ',') result += "\\allowbreak{}";
    }
    return result;
}

std::string latexRow(const std::vector<std::string>& cells) {
    std::vector<std::string> escaped;
    for (const std::string& cell : cells) escaped.push_back(latexText(cell));
    return fmt::format("{} \\\\\n", fmt::join(escaped, " & "));
}

std::string inLatex(const report::TextTable& table) {
    // The widths add up to a line of the page, less the space between columns.
    std::string text = "% \\usepackage{booktabs,longtable,array}, on a wide page\n"
                       "\\begin{longtable}{@{}";
    constexpr double widths[] = {0.08, 0.1, 0.13, 0.13, 0.09, 0.06, 0.13, 0.13, 0.09, 0.06};
    for (const double width : widths)
        text += fmt::format(">{{\\raggedright\\arraybackslash}}p{{{}\\linewidth}}", width * 0.85);
    text += "@{}}\n\\toprule\n" + latexRow(table.titles) + "\\midrule\n\\endhead\n\\bottomrule\n\\endfoot\n";
    for (const std::vector<std::string>& row : table.rows) text += latexRow(row);
    return text + "\\end{longtable}\n";
}

/// Every column is text, so all are to the left.
std::string inMarkdown(const report::TextTable& table) {
    const auto row = [](const std::vector<std::string>& cells) {
        std::string text = "|";
        for (const std::string& cell : cells) text += fmt::format(" {} |", report::markdownText(cell));
        return text + "\n";
    };
    std::string text = row(table.titles) + "|";
    for (std::size_t i = 0; i < table.titles.size(); ++i) text += ":---|";
    text += "\n";
    for (const std::vector<std::string>& cells : table.rows) text += row(cells);
    return text;
}

} // namespace

std::vector<std::string> cellsOf(const std::string& technique, const Asserted& asserted,
                                 const std::vector<Record>& records) {
    const std::string scene =
        asserted.variant == technique ? asserted.scene : fmt::format("{} ({})", asserted.scene, asserted.variant);
    return {asserted.says, asserted.test, scene,
            fmt::format("{} {}", shortName(asserted.metric), valueOf(asserted, records))};
}

std::string behaviourTable(const std::vector<Behaviour>& behaviours, const std::vector<Record>& records, Markup markup) {
    const report::TextTable all = table(behaviours, records);
    return markup == Markup::Latex ? inLatex(all) : inMarkdown(all);
}

} // namespace shadowbench
