#include "harness/metrics/values.h"

#include "base/error.h"
#include "harness/metrics/frames.h"

#include <algorithm>

namespace shadowbench::metrics {

const std::vector<double>& Values::list(MetricId id) const {
    static const std::vector<double> none;
    const auto found = lists_.find(id.index());
    return found == lists_.end() ? none : found->second;
}

bool Values::any(std::span<const Metric> lines) const {
    return std::ranges::any_of(lines, [&](const Metric& m) { return (*this)[m].has_value() || !list(MetricId(m)).empty(); });
}

void Values::clear(const Metric& line) {
    (*this)[line].reset();
    lists_.erase(MetricId(line).index());
}

template <class Kind>
void appendFrame(const ScoredFrame& frame, Values& values) {
    Results<ScoredFrame> results(frame);
    for (const Metric& line : table) {
        const Kind* kind = std::get_if<Kind>(&line.computed);
        if (kind == nullptr) continue;
        const std::optional<double> value = kind->value(results);
        if (!value) throw BadInput("scoring a frame in which no pixel shows a receiver; turn the camera or the light");
        values.list(MetricId(line)).push_back(*value);
    }
}
template void appendFrame<LabelsByFrame>(const ScoredFrame&, Values&);
template void appendFrame<VisibilityByFrame>(const ScoredFrame&, Values&);

void computeLists(const StillFrames& frames, Values& values) {
    for (const Metric& line : table)
        if (const auto* kind = std::get_if<ByStillFrame>(&line.computed)) values.list(MetricId(line)) = kind->values(frames);
}

std::optional<double> bounded(const Values& values, std::string_view name) {
    const Metric* metric = boundedMetric(name);
    return metric == nullptr ? std::nullopt : values[*metric];
}

} // namespace shadowbench::metrics
