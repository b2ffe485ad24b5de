// How much of a change means nothing.
#include "harness/records/compare.h"

#include <algorithm>
#include <cmath>

namespace shadowbench::gate {
namespace {

using metrics::TruthError;

/// The truth that a metric was computed from. A hard technique on an area light has two.
const std::optional<ReferenceInfo>& truthThatJudged(const metrics::Metric& metric, const Record& record) {
    const bool graded = std::holds_alternative<metrics::OfVisibility>(metric.computed);
    return graded && record.softReference ? record.softReference : record.reference;
}

/// Pixels of the class that the metric is of; of the whole image where the record does not say, as older ones do not.
double pixelsOf(const Limit& limit, const Record& record) {
    const metrics::Metric* size = limit.of.empty() ? nullptr : metrics::metricAt(limit.of);
    const double image = static_cast<double>(record.width) * record.height;
    return std::max(1.0, size == nullptr ? image : record.values[*size].value_or(image));
}

/// σ* is of the penumbra: over more pixels than that it counts for less.
double sigmaOver(const metrics::Metric& metric, const Limit& limit, const Record& record, double pixels) {
    const std::optional<ReferenceInfo>& truth = truthThatJudged(metric, record);
    const std::optional<double>& penumbra = record.values["accuracy.pixels.penumbra"];
    const double sigma = truth ? truth->sigma : 0;
    const bool whole = limit.of == "accuracy.pixels.graded" && penumbra;
    return whole ? sigma * std::sqrt(std::min(1.0, *penumbra / pixels)) : sigma;
}

/// An error e measured against a truth that is off by σ reads √(e² + σ²). An exact truth is off by the stray pixels.
double truthsOwn(const metrics::Metric& metric, const Limit& limit, const Record& record, double value, double stray) {
    if (limit.truth == TruthError::None) return 0;
    const double sigma = sigmaOver(metric, limit, record, pixelsOf(limit, record));
    if (sigma == 0 && limit.truth == TruthError::Mean) return stray;
    const double off = sigma > 0 ? sigma : std::sqrt(stray);
    return std::hypot(value, off) - value;
}

/// The group of metrics that a metric belongs to: "stability" of "stability.flicker.mean".
std::string_view groupOf(const metrics::Metric& metric) { return metric.path.substr(0, metric.path.find('.')); }

/// What is compared of a value that is absent.
std::optional<double> standIn(const metrics::Metric& metric, const Record& record, metrics::Absent absent) {
    if (absent == metrics::Absent::Best && record.values.any(metrics::linesOf(groupOf(metric)))) return 0.0;
    const std::size_t frames = record.values.list("stability.by_frame.changed").size(); // the still ones
    if (absent == metrics::Absent::AfterTheEnd && frames > 0) return static_cast<double>(frames + 1);
    return {};
}

} // namespace

std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record, const Rules& rules) {
    const auto limit = rules.limits.find(metric.path);
    if (limit == rules.limits.end()) return {};
    const std::optional<double>& value = record.values[metric];
    if (!value) return standIn(metric, record, limit->second.absent);
    const Limit& l = limit->second;
    return l.magnitude || l.best != 0 ? std::abs(*value - l.best) : *value;
}

double allowanceOf(const metrics::Metric& metric, const Record& base, double value, const Rules& rules) {
    const Limit& limit = rules.limits.find(metric.path)->second;
    const double pixels = pixelsOf(limit, base);
    const double own = truthsOwn(metric, limit, base, value, rules.strayPixels / pixels);
    return std::max({limit.pixels / pixels, own, limit.absolute}) + limit.relative * std::abs(value);
}

} // namespace shadowbench::gate
