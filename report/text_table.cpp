#include "report/text_table.h"

#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

/// Columns of a terminal that UTF-8 text takes.
std::size_t displayWidth(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

std::string spaces(std::size_t wanted, const std::string& text) { return std::string(wanted - displayWidth(text), ' '); }

std::vector<std::size_t> widths(const TextTable& table) {
    std::vector<std::size_t> result;
    for (std::size_t column = 0; column < table.titles.size(); ++column) {
        result.push_back(displayWidth(table.titles[column]));
        for (const std::vector<std::string>& row : table.rows)
            result.back() = std::max(result.back(), displayWidth(row[column]));
    }
    return result;
}

std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) {
    std::string text = fmt::format(" {}{}", cells[0], spaces(widths[0], cells[0]));
    for (std::size_t i = 1; i < cells.size(); ++i) text += fmt::format("   {}{}", spaces(widths[i], cells[i]), cells[i]);
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string markdownRow(const std::vector<std::string>& cells, const std::string& small = "") {
    std::string text = "|";
    for (std::size_t i = 0; i < cells.size(); ++i)
        text += i == 0 && !small.empty() ? fmt::format(" {}<br><sub>{}</sub> |", markdownText(cells[i]), markdownText(small))
                                         : fmt::format(" {} |", markdownText(cells[i]));
    return text + "\n";
}

} // namespace

std::string aligned(const TextTable& table) {
    const std::vector<std::size_t> columns = widths(table);
    std::string text = line(table.titles, columns);
    for (const std::vector<std::string>& row : table.rows) text += line(row, columns);
    return text;
}

std::string markdown(const TextTable& table) {
    if (table.rows.empty()) return "";
    std::string text = markdownRow(table.titles) + "|:---|";
    for (std::size_t i = 1; i < table.titles.size(); ++i) text += "---:|";
    text += "\n";
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        text += markdownRow(table.rows[i], table.small.empty() ? "" : table.small[i]);
    return text;
}

} // namespace shadowbench::report
