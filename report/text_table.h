// Rows of text, aligned for a terminal or in Markdown.
#pragma once

#include <string>
#include <vector>

namespace shadowbench::report {

/// Every row has as many cells as there are titles; the first column holds names.
struct TextTable {
    std::vector<std::string> titles;
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> small = {}; // of each row, what Markdown has in small print below its name; or none at all
};

/// Names to the left, figures to the right; UTF-8 whose characters are one column wide.
std::string aligned(const TextTable& table);

/// A Markdown table. Nothing without rows.
std::string markdown(const TextTable& table);

} // namespace shadowbench::report
