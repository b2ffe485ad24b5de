// The documents' tables with our numbers beside theirs.
#include "base/files.h"
#include "report/summary.h"
#include "studies/claims/claims.h"
#include "studies/papers/papers.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench {
namespace {

std::string asText(const std::optional<double>& number) { return number ? fmt::format("{:.4g}", *number) : "–"; }

std::optional<double> quotient(const std::optional<double>& number, const std::optional<double>& of) {
    return number && of && *of != 0 ? std::optional(*number / *of) : std::nullopt;
}

/// One column: the published numbers and ours, as they are or as multiples of one row's.
struct Compared {
    const PaperColumn& column;
    std::vector<std::optional<double>> published, theirs, ours; // by row; `theirs` and `ours` are what is compared
};

Compared compare(const PaperTable& table, std::size_t index, const std::vector<Record>& records) {
    const PaperColumn& column = table.columns[index];
    Compared result{column, {}, {}, {}};
    for (const PaperRow& row : table.rows) {
        result.published.push_back(row.published[index]);
        Figure figure;
        figure.scene = column.scene;
        figure.variant = row.variant;
        figure.profile = column.profile;
        figure.metric = column.metric;
        result.ours.push_back(lookUp(figure, records));
    }
    result.theirs = result.published;
    const auto per = std::ranges::find(table.rows, column.per, &PaperRow::variant);
    if (per == table.rows.end()) return result;
    const auto unit = static_cast<std::size_t>(per - table.rows.begin());
    const std::optional<double> theirUnit = result.theirs[unit], ourUnit = result.ours[unit];
    for (std::optional<double>& number : result.theirs) number = quotient(number, theirUnit);
    for (std::optional<double>& number : result.ours) number = quotient(number, ourUnit);
    return result;
}

std::optional<double> correlation(const Compared& column) {
    std::vector<double> ours, theirs;
    for (std::size_t i = 0; i < column.ours.size(); ++i)
        if (column.ours[i] && column.theirs[i]) {
            ours.push_back(*column.ours[i]);
            theirs.push_back(*column.theirs[i]);
        }
    return rankCorrelation(ours, theirs);
}

std::string markdown(const PaperTable& table, const std::vector<Record>& records) {
    std::vector<Compared> columns;
    for (std::size_t i = 0; i < table.columns.size(); ++i) columns.push_back(compare(table, i, records));

    std::string head = "| published as | variant |", rule = "|:---|:---|", last = "| rank correlation | |";
    for (const Compared& c : columns) {
        const bool multiple = !c.column.per.empty();
        head += fmt::format(" {} |", c.column.title);
        head += multiple ? fmt::format(" × {} | ours × {} |", c.column.per, c.column.per) : " ours |";
        rule += multiple ? "---:|---:|---:|" : "---:|---:|";
        last += fmt::format("{} {} |", multiple ? " | |" : " |", asText(correlation(c)));
    }
    std::string text = head + "\n" + rule + "\n";
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        text += fmt::format("| {} | {} |", table.rows[row].title, table.rows[row].variant);
        for (const Compared& c : columns) {
            text += fmt::format(" {} |", asText(c.published[row]));
            if (!c.column.per.empty()) text += fmt::format(" {} |", asText(c.theirs[row]));
            text += fmt::format(" {} |", asText(c.ours[row]));
        }
        text += "\n";
    }
    return text + last + "\n\n";
}

} // namespace

std::string paperPage(const PaperPage& page, const std::vector<Record>& records, const std::vector<std::string>& charts) {
    std::string text = fmt::format("## {}\n\n{}. {}.\n\n", page.title, page.where, page.says);
    if (page.table) text += markdown(*page.table, records);
    for (const std::string& chart : charts) text += fmt::format("![{}]({})\n\n", page.title, chart);
    return text;
}

report::Written writePapers(const std::vector<Record>& records, const std::filesystem::path& folder) {
    report::Written written{folder / "report.md", {}};
    std::string text =
        "# The documents' tables and figures, and ours\n\nPublished numbers are the documents'; ours are read "
        "from records. Times of old machines are compared as multiples of one row's.\n\n";
    for (const PaperPage& page : paperPages()) {
        std::vector<std::string> charts;
        for (const PaperChart& chart : page.charts) {
            const std::optional<std::string> svg = paperChart(chart, records);
            if (!svg) continue;
            charts.push_back(fmt::format("{}-{}.svg", page.id, chart.scene));
            writeFile(folder / charts.back(), *svg);
            written.charts.push_back(folder / charts.back());
        }
        text += paperPage(page, records, charts);
    }
    writeFile(written.page, text);
    return written;
}

} // namespace shadowbench
