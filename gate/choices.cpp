#include "gate/choices.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <optional>
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

    void giveUpFirst() { pairs_.erase(pairs_.begin()); }

    void cover(const Row& row) {
        for (std::size_t a = 0; a < row.size(); ++a)
            for (std::size_t b = a + 1; b < row.size(); ++b) pairs_.erase({a, row[a], b, row[b]});
    }

private:
    std::set<Pair> pairs_;
};

/// Finds the row of one open pair with what gains most in every other column, as far as the choices go together.
class RowSearch {
public:
    RowSearch(const std::vector<std::size_t>& sizes, const Uncovered& uncovered, const GoTogether& goTogether)
        : sizes_(sizes), uncovered_(uncovered), goTogether_(goTogether), row_(sizes.size(), open) {}

    /// Nothing if the pair is in no row whose choices go together.
    std::optional<Row> ofFirstPair() {
        const auto& [a, i, b, k] = uncovered_.first();
        row_[a] = i;
        row_[b] = k;
        return complete(0) ? std::optional(row_) : std::nullopt;
    }

private:
    /// Fills in the open columns from `column` on; leaves them open where that cannot be done.
    bool complete(std::size_t column) {
        while (column < row_.size() && row_[column] != open) ++column;
        if (column == row_.size()) return goTogether_(row_);
        std::vector<std::pair<std::size_t, std::size_t>> choices; // gain, choice
        for (std::size_t choice = 0; choice < sizes_[column]; ++choice)
            choices.emplace_back(uncovered_.gain(row_, column, choice), choice);
        std::ranges::stable_sort(choices, std::greater(), &std::pair<std::size_t, std::size_t>::first);
        for (const auto& [gain, choice] : choices) {
            row_[column] = choice;
            if (complete(column + 1)) return true;
        }
        row_[column] = open;
        return false;
    }

    const std::vector<std::size_t>& sizes_;
    const Uncovered& uncovered_;
    const GoTogether& goTogether_;
    Row row_;
};

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

std::vector<std::vector<std::size_t>> pairwiseRows(const std::vector<std::size_t>& sizes, const GoTogether& goTogether) {
    std::vector<Row> rows;
    if (sizes.size() == 1)
        for (std::size_t choice = 0; choice < sizes[0]; ++choice)
            if (goTogether({choice})) rows.push_back({choice});
    for (Uncovered uncovered(sizes); !uncovered.empty();) {
        if (const auto row = RowSearch(sizes, uncovered, goTogether).ofFirstPair()) {
            rows.push_back(*row);
            uncovered.cover(*row);
        } else {
            uncovered.giveUpFirst();
        }
    }
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
    const auto chosen = [&](const Row& row) {
        std::vector<std::pair<std::string, std::string>> values;
        for (std::size_t i = 0; i < row.size(); ++i) values.emplace_back(entry.parameters[i].name, choices[i][row[i]]);
        return techniques::Parameters(std::move(values));
    };
    const auto goTogether = [&](const Row& row) { return !entry.contradiction || !entry.contradiction(chosen(row)); };
    std::vector<std::string> variants;
    for (const Row& row : pairwiseRows(sizes, goTogether)) {
        const std::string text = techniques::canonicalVariant(entry.id, chosen(row), entry.parameters);
        const std::string name = techniques::parseVariant(text).name;
        if (std::ranges::find(variants, name) == variants.end()) variants.push_back(name);
    }
    return variants;
}

} // namespace shadowbench::gate
