// Cells and lines of comma-separated values (RFC 4180).
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <type_traits>
#include <vector>

namespace shadowbench::report {

inline std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char letter : text) {
        if (letter == '"') result += '"';
        result += letter;
    }
    return result + "\"";
}

inline std::string csvText(bool value) { return value ? "true" : "false"; }
template <typename T>
requires std::is_arithmetic_v<T> std::string csvText(T value) {
    return fmt::format("{}", value); // the shortest text that reads back equal
}

inline std::string csvLine(const std::vector<std::string>& cells) { return fmt::format("{}\n", fmt::join(cells, ",")); }

} // namespace shadowbench::report
