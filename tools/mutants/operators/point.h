// A place in a source file at which an operator makes a mutant, and the file with many of them behind the switch.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

struct Point {
    std::size_t begin = 0, end = 0; // of the expression, or of the statement with its semicolon
    std::string operation;          // "negated comparison"
    std::string after;              // what stands there instead; "": the statement is left out
    int number = 0;                 // by which the switch knows it, from 1
};

struct Switched {
    std::string text;
    struct Range {
        std::size_t begin = 0, end = 0;
        int number = 0;
    };
    std::vector<Range> ranges; // of the points in `text`

    /// The number of the innermost point around `offset` of `text`.
    [[nodiscard]] std::optional<int> around(std::size_t offset) const;
};

/// `source` with each point's original and changed text behind `::mutants::active(number)`. Points must nest: one holds the
/// other, is equal to it or lies apart from it.
Switched switched(std::string_view source, std::vector<Point> points);

} // namespace shadowbench::mutants
