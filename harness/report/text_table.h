// Tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace shadowbench::report {

/// UTF-8 text, one column of the terminal a character.
struct TextTable {
    std::vector<std::string> titles;
    std::vector<std::vector<std::string>> rows; // each as long as the titles
};

/// A line for the titles and one for each row: the first column to the left, the others to the right.
std::string aligned(const TextTable& table);

} // namespace shadowbench::report
