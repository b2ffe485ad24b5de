#include "gate/bounds.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::gate {
namespace {

Change judged(const Record& record, const BoundRule& rule) {
    const auto& [metric, bound, below] = rule.bound;
    const std::optional<double> value = metrics::bounded(record.values, metric);
    const std::string is = value ? fmt::format("is {:.6g}", *value) : "is not measured";
    const std::string what =
        below ? fmt::format("must be below {}", bound) : fmt::format("is expected to fail, above {}", bound);
    return {record.scene,
            record.variant,
            "bound." + metric,
            *metrics::boundedMetric(metric)->about,
            bound,
            value,
            0,
            !value                        ? Direction::NotCompared
            : rule.bound.isKeptBy(*value) ? Direction::Same
                                          : Direction::Worse,
            fmt::format("{} on {}: {} {} and {}: {}", record.variant, record.scene, metric, is, what, rule.cells.reason)};
}

/// A bound that no scored record of its scene is of.
Change vacuous(const BoundRule& rule) {
    const auto& [cells, bound] = rule;
    const std::string techniques = fmt::format("{}", fmt::join(cells.techniques, ", "));
    return {cells.scene,
            techniques,
            "bound." + bound.metric,
            *metrics::boundedMetric(bound.metric)->about,
            bound.value,
            {},
            0,
            Direction::NotCompared,
            fmt::format("{} on {}: the bound on {} met no result", techniques, cells.scene, bound.metric)};
}

} // namespace

std::string text(const Bound& bound) {
    return fmt::format("{} {} {}", bound.metric, bound.below ? "below" : "above", bound.value);
}

std::vector<BoundRule> boundsOf(const Scene& scene) {
    std::vector<BoundRule> bounds;
    for (const auto& [technique, bound, reason] : scene.expectations)
        if (metrics::boundedMetric(bound.metric)->notCompared != metrics::onDemand) // the gate measures nothing on demand
            bounds.push_back({{scene.id, {technique}, {}, reason}, bound});
    return bounds;
}

std::vector<Change> judgeBounds(const std::vector<Record>& records, const std::vector<BoundRule>& bounds, bool all) {
    std::vector<Change> changes;
    std::vector<bool> met(bounds.size(), false);
    for (const Record& record : records) {
        if (!wasScored(record.status) || record.sweep) continue;
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            if (bounds[i].cells.scene != record.scene || !bounds[i].cells.covers(record.variant)) continue;
            met[i] = true;
            changes.push_back(judged(record, bounds[i]));
        }
    }
    for (std::size_t i = 0; all && i < bounds.size(); ++i)
        if (!met[i]) changes.push_back(vacuous(bounds[i]));
    return changes;
}

} // namespace shadowbench::gate
