#include "harness/report/text_table.h"

#include <algorithm>

namespace shadowbench::report {
namespace {

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
    std::string text = " " + cells[0] + spaces(widths[0], cells[0]);
    for (std::size_t i = 1; i < cells.size(); ++i) text += "   " + spaces(widths[i], cells[i]) + cells[i];
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

} // namespace

std::string aligned(const TextTable& table) {
    const std::vector<std::size_t> columns = widths(table);
    std::string text = line(table.titles, columns);
    for (const std::vector<std::string>& row : table.rows) text += line(row, columns);
    return text;
}

} // namespace shadowbench::report
