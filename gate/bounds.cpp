#include "gate/bounds.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::gate {
namespace {

Change judged(const Record& record, const Bound& bound) {
    const std::optional<double> value = metrics::bounded(record.values, bound.metric);
    const bool kept = value && (bound.below ? *value < bound.value : *value > bound.value);
    const std::string is = value ? fmt::format("is {:.6g}", *value) : "is not measured";
    const std::string what = bound.below ? fmt::format("must be below {}", bound.value)
                                         : fmt::format("is expected to fail, above {}", bound.value);
    return {
        record.scene,
        record.variant,
        "bound." + bound.metric,
        *metrics::boundedMetric(bound.metric)->about,
        bound.value,
        value,
        0,
        !value ? Direction::NotCompared
        : kept ? Direction::Same
               : Direction::Worse,
        fmt::format("{} on {}: {} {} and {}: {}", record.variant, record.scene, bound.metric, is, what, bound.cells.reason)};
}

/// A bound that no scored record of its scene is of.
Change vacuous(const Bound& bound) {
    const std::string techniques = fmt::format("{}", fmt::join(bound.cells.techniques, ", "));
    return {bound.cells.scene,
            techniques,
            "bound." + bound.metric,
            *metrics::boundedMetric(bound.metric)->about,
            bound.value,
            {},
            0,
            Direction::NotCompared,
            fmt::format("{} on {}: the bound on {} met no result", techniques, bound.cells.scene, bound.metric)};
}

/// The gate measures nothing that is measured on demand alone.
std::vector<Bound> listOf(const Scene& scene, const std::vector<Expectation>& expectations, bool below) {
    std::vector<Bound> bounds;
    for (const Expectation& e : expectations)
        if (metrics::boundedMetric(e.metric)->notCompared != metrics::onDemand)
            bounds.push_back({{scene.id, {e.technique}, {}, e.reason}, e.metric, e.bound, below});
    return bounds;
}

} // namespace

std::vector<Bound> boundsOf(const Scene& scene) {
    std::vector<Bound> bounds = listOf(scene, scene.holds, true);
    for (Bound& failure : listOf(scene, scene.fails, false)) bounds.push_back(std::move(failure));
    return bounds;
}

std::vector<Change> judgeBounds(const std::vector<Record>& records, const std::vector<Bound>& bounds, bool all) {
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
