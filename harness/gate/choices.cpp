#include "harness/gate/choices.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <tuple>

namespace shadowbench::gate {
namespace {

using Row = std::vector<std::size_t>;
constexpr std::size_t open = static_cast<std::size_t>(-1); // a column without a choice yet

/// Two columns and what is chosen in them.
using Pair = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t>;
Pair pairOf(std::size_t column, std::size_t choice, std::size_t other, std::size_t otherChoice) {
    return column < other ? Pair{column, choice, other, otherChoice} : Pair{other, otherChoice, column, choice};
}

class Uncovered {
public:
    explicit Uncovered(const std::vector<std::size_t>& sizes) {
        for (std::size_t a = 0; a < sizes.size(); ++a)
            for (std::size_t b = a + 1; b < sizes.size(); ++b)
                for (std::size_t i = 0; i < sizes[a]; ++i)
                    for (std::size_t k = 0; k < sizes[b]; ++k) pairs_.insert({a, i, b, k});
    }

    [[nodiscard]] bool empty() const { return pairs_.empty(); }
    [[nodiscard]] const Pair& first() const { return *pairs_.begin(); }

    /// Pairs that `choice` in `column` makes with the row's other columns.
    [[nodiscard]] std::size_t gain(const Row& row, std::size_t column, std::size_t choice) const {
        std::size_t gained = 0;
        for (std::size_t other = 0; other < row.size(); ++other)
            if (other != column && row[other] != open) gained += pairs_.count(pairOf(column, choice, other, row[other]));
        return gained;
    }

    void cover(const Row& row) {
        for (std::size_t a = 0; a < row.size(); ++a)
            for (std::size_t b = a + 1; b < row.size(); ++b) pairs_.erase({a, row[a], b, row[b]});
    }

private:
    std::set<Pair> pairs_;
};

/// The row of one open pair, with what gains most in every other column.
Row nextRow(const std::vector<std::size_t>& sizes, const Uncovered& uncovered) {
    Row row(sizes.size(), open);
    const auto& [a, i, b, k] = uncovered.first();
    row[a] = i;
    row[b] = k;
    for (std::size_t column = 0; column < sizes.size(); ++column) {
        if (row[column] != open) continue;
        std::size_t best = 0;
        for (std::size_t choice = 1; choice < sizes[column]; ++choice)
            if (uncovered.gain(row, column, choice) > uncovered.gain(row, column, best)) best = choice;
        row[column] = best;
    }
    return row;
}

struct Choices {
    std::vector<std::string> operator()(const techniques::OneOf& words) const { return words.values; }
    std::vector<std::string> operator()(const techniques::IntegerRange& range) const { return withDefault(range.low); }
    std::vector<std::string> operator()(const techniques::RealRange& range) const { return withDefault(range.low); }

    [[nodiscard]] std::vector<std::string> withDefault(auto low) const {
        const std::string least = fmt::format("{}", low);
        return least == defaultValue ? std::vector{defaultValue} : std::vector{defaultValue, least};
    }

    std::string defaultValue;
};

} // namespace

std::vector<std::vector<std::size_t>> pairwiseRows(const std::vector<std::size_t>& sizes) {
    std::vector<Row> rows;
    if (sizes.size() == 1)
        for (std::size_t choice = 0; choice < sizes[0]; ++choice) rows.push_back({choice});
    for (Uncovered uncovered(sizes); !uncovered.empty(); uncovered.cover(rows.back()))
        rows.push_back(nextRow(sizes, uncovered));
    return rows;
}

std::vector<std::string> choicesOf(const techniques::Parameter& parameter) {
    return std::visit(Choices{parameter.defaultValue}, parameter.domain);
}

std::vector<std::string> pairwiseVariants(const techniques::Entry& entry) {
    std::vector<std::vector<std::string>> choices;
    std::vector<std::size_t> sizes;
    for (const techniques::Parameter& parameter : entry.parameters) {
        choices.push_back(choicesOf(parameter));
        sizes.push_back(choices.back().size());
    }
    if (sizes.empty()) return {entry.id};
    std::vector<std::string> variants;
    for (const Row& row : pairwiseRows(sizes)) {
        std::vector<std::string> words;
        for (std::size_t i = 0; i < row.size(); ++i)
            words.push_back(fmt::format("{}={}", entry.parameters[i].name, choices[i][row[i]]));
        const std::string text = fmt::format("{}:{}", entry.id, fmt::join(words, ","));
        const std::string name = techniques::parseVariant(text).name;
        if (std::ranges::find(variants, name) == variants.end()) variants.push_back(name);
    }
    return variants;
}

} // namespace shadowbench::gate
