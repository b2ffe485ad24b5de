#include "report/costing.h"

#include "report/slug.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace shadowbench::report {
namespace {

/// Of the size of the model's median error against what was measured (docs/gpu-cost.md).
constexpr double modelSpread = 0.05;

const ModelledCost* costOn(const std::string& name, const Record& record) {
    const auto found = record.modelled.find(name);
    return found == record.modelled.end() || found->second.waits ? nullptr : &found->second;
}

} // namespace

Costing measuredHere(const std::vector<Record>& records, const std::string& scene) {
    return {frameCost, standingCost, costMeaning(records, scene), "×", ""};
}

Costing modelledOn(const std::string& name) {
    const auto dearer = [name](const Record& record) -> std::optional<FrameCost> {
        const ModelledCost* cost = costOn(name, record);
        if (cost == nullptr) return {};
        return FrameCost{std::max(cost->milliseconds, cost->motion.value_or(0))};
    };
    const auto standing = [name](const Record& record) -> std::optional<FrameCost> {
        const ModelledCost* cost = costOn(name, record);
        if (cost == nullptr) return {};
        return FrameCost{cost->milliseconds};
    };
    return {dearer, standing, fmt::format("ms on {}, modelled: the dearer of standing and in motion", cardAndSize(name)),
            "ms",   name,     modelSpread};
}

std::vector<std::string> modelledNames(const std::vector<Record>& records, const std::string& scene) {
    std::set<std::string> names;
    for (const std::size_t i : ofScene(records, scene))
        for (const auto& [name, cost] : records[i].modelled) names.insert(name);
    return {names.begin(), names.end()};
}

Costing shownCosting(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<std::string> names = modelledNames(records, scene);
    return names.empty() ? measuredHere(records, scene) : modelledOn(names.front());
}

std::string chartName(const Costing& costing) {
    if (costing.card.empty()) return "pareto";
    std::string name = costing.card;
    std::ranges::replace(name, '@', '-');
    return "modelled-" + slug(name);
}

std::string cardAndSize(const std::string& name) {
    const std::size_t at = name.find('@'), cross = name.rfind('x');
    if (at == std::string::npos || cross == std::string::npos || cross < at) return name;
    return fmt::format("{} at {}×{}", name.substr(0, at), name.substr(at + 1, cross - at - 1), name.substr(cross + 1));
}

} // namespace shadowbench::report
