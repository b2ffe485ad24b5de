// The cheapest choice among several levels for each of several groups.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace shadowbench::recommend {

/// The level of every group; 0 is the finest.
using Levels = std::vector<std::size_t>;

/// What each group costs at each of its levels: [group][level], every group with at least one.
using Costs = std::vector<std::vector<std::size_t>>;

/// More choices than this are not searched.
constexpr std::size_t mostChoices = std::size_t{1} << 22U;

struct Choice {
    Levels levels;
    std::size_t tried;    // choices that were judged, this one too
    std::size_t possible; // all that there are
};

/// The choice of least total cost that `isAdequate` accepts; nothing if it accepts none.
///
/// Choices are judged in the order of their cost, and the first one accepted is the answer. So the answer is the optimum
/// whatever the errors do: shadows of different groups overlap, and the error of a choice is neither the sum of its groups'
/// errors nor sure to grow with any of them, so a budget for each group, or a descent from the finest levels, could stop
/// short of it. And every cheaper choice is known to fail: above all the one with any one group a level coarser. Equal costs
/// are judged in the order of the levels, the first group's first.
/// Throws BadInput when there are more than `mostChoices`.
std::optional<Choice> cheapestAdequate(const Costs& costs, const std::function<bool(const Levels&)>& isAdequate);

std::size_t totalCost(const Costs& costs, const Levels& levels);

} // namespace shadowbench::recommend
