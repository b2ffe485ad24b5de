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
double pixelsOf(const metrics::Allowance& allowance, const Record& record) {
    const metrics::Metric* size = allowance.of.empty() ? nullptr : metrics::metricAt(allowance.of);
    const double image = static_cast<double>(record.width) * record.height;
    return std::max(1.0, size == nullptr ? image : record.values[*size].value_or(image));
}

/// σ* is of the penumbra: over more pixels than that it counts for less.
double sigmaOver(const metrics::Metric& metric, const Record& record, double pixels) {
    const std::optional<ReferenceInfo>& truth = truthThatJudged(metric, record);
    const std::optional<double>& penumbra = record.values["accuracy.pixels.penumbra"];
    const double sigma = truth ? truth->sigma : 0;
    const bool whole = metric.allowance->of == "accuracy.pixels.graded" && penumbra;
    return whole ? sigma * std::sqrt(std::min(1.0, *penumbra / pixels)) : sigma;
}

/// An error e measured against a truth that is off by σ reads √(e² + σ²). An exact truth is off by two stray pixels, whose
/// centres lie on an edge: their labels are arbitrary.
double truthsOwn(const metrics::Metric& metric, const Record& record, double value, double pixels) {
    constexpr double strayPixels = 2;
    const TruthError kind = metric.allowance->truth;
    if (kind == TruthError::None) return 0;
    const double sigma = sigmaOver(metric, record, pixels), stray = strayPixels / pixels;
    if (sigma == 0 && kind == TruthError::Mean) return stray;
    const double off = sigma > 0 ? sigma : std::sqrt(stray);
    return std::hypot(value, off) - value;
}

} // namespace

std::optional<double> comparedValue(const metrics::Metric& metric, const Record& record) {
    const std::optional<double>& value = record.values[metric];
    if (!metric.allowance || !value) return {};
    const metrics::Allowance& allowance = *metric.allowance;
    return allowance.magnitude || allowance.best != 0 ? std::abs(*value - allowance.best) : *value;
}

double allowanceOf(const metrics::Metric& metric, const Record& base, double value) {
    const metrics::Allowance& allowance = *metric.allowance;
    const double pixels = pixelsOf(allowance, base);
    return std::max({allowance.pixels / pixels, truthsOwn(metric, base, value, pixels), allowance.absolute}) +
           allowance.relative * std::abs(value);
}

} // namespace shadowbench::gate
