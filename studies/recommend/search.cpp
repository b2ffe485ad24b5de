#include "studies/recommend/search.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace shadowbench::recommend {
namespace {

std::size_t choicesOf(const Costs& costs) {
    std::size_t count = 1;
    for (const std::vector<std::size_t>& levels : costs) {
        count *= levels.size();
        if (count > mostChoices)
            throw BadInput(fmt::format("{} groups of casters have more than {} choices of levels: ask for fewer distance "
                                       "bands or fewer levels",
                                       costs.size(), mostChoices));
    }
    return count;
}

/// Choice number `number`, the last group's level changing fastest.
Levels choice(const Costs& costs, std::size_t number) {
    Levels levels(costs.size());
    for (std::size_t group = costs.size(); group-- > 0;) {
        levels[group] = number % costs[group].size();
        number /= costs[group].size();
    }
    return levels;
}

} // namespace

std::size_t totalCost(const Costs& costs, const Levels& levels) {
    std::size_t sum = 0;
    for (std::size_t group = 0; group < costs.size(); ++group) sum += costs[group][levels[group]];
    return sum;
}

std::optional<Choice> cheapestAdequate(const Costs& costs, const std::function<bool(const Levels&)>& isAdequate) {
    std::vector<std::pair<std::size_t, std::size_t>> byCost(choicesOf(costs)); // cost, number
    for (std::size_t number = 0; number < byCost.size(); ++number)
        byCost[number] = {totalCost(costs, choice(costs, number)), number};
    std::ranges::sort(byCost);
    for (std::size_t i = 0; i < byCost.size(); ++i) {
        Levels levels = choice(costs, byCost[i].second);
        if (isAdequate(levels)) return Choice{std::move(levels), i + 1, byCost.size()};
    }
    return std::nullopt;
}

} // namespace shadowbench::recommend
