#include "harness/records/metric_code.h"

#include "harness/records/comparability.h"

namespace shadowbench::gate {
namespace {

using metrics::Class;

bool isScore(const metrics::Metric& metric) {
    return metric.about != Class::Work && metric.about != Class::Instructions && metric.about != Class::Time;
}

/// What is computed of the map is not: it may change behind equal images.
bool dependsOnImages(const metrics::Metric& metric) { return !std::holds_alternative<metrics::OfMap>(metric.computed); }

} // namespace

void MetricCode::take(const Record& before, const Record& now) {
    if (sameMetricCode(before, now) || !sameImages(before, now) || whyIncomparable(before, now)) return;
    for (const metrics::Metric& metric : metrics::table) {
        if ((!before.values[metric] && !now.values[metric]) || whyIncomparable(metric, before, now)) continue;
        Seen& seen = seen_[{metric.path, before.metricCode, now.metricCode}];
        (before.values[metric] == now.values[metric] ? seen.alike : seen.unlike) = true;
    }
}

MetricCode::Seen MetricCode::seen(const metrics::Metric& metric, const Record& before, const Record& now) const {
    const auto found = seen_.find({metric.path, before.metricCode, now.metricCode});
    return found == seen_.end() ? Seen{} : found->second;
}

std::optional<std::string> MetricCode::whyUnjudged(const metrics::Metric& metric, const Record& before, const Record& now,
                                                   bool sameImages, bool same) const {
    if (!isScore(metric) && metric.about != Class::Work) return {};
    const Seen code = sameMetricCode(before, now) ? Seen{true, false} : seen(metric, before, now);
    if (metric.about == Class::Work) {
        if (same || code.alike) return {};
        return "the code that measures differs, and no cell whose images are the same shows that it counts alike";
    }
    if (auto why = whyIncomparable(metric, before, now)) return why;
    if (sameImages && dependsOnImages(metric)) {
        if (same) return {};
        return "images and truth are the same, so what measures, scores or records them changed";
    }
    if (code.alike && !code.unlike) return {};
    return "the code of the metrics differs, and cells whose images are the same do not show that it scores alike";
}

} // namespace shadowbench::gate
