#include "harness/records/record.h"

#include "harness/records/fields.h"

namespace shadowbench {
namespace {

/// Finds one number of a struct by its key.
class Finder {
public:
    explicit Finder(std::string_view key) : key_(key) {}
    void operator()(std::string_view key, const std::optional<double>& value) {
        if (key == key_) found_ = value;
    }
    void operator()(std::string_view, const std::optional<EdgeError>&) {}
    [[nodiscard]] std::optional<double> found() const { return found_; }

private:
    std::string_view key_;
    std::optional<double> found_;
};

bool isSoft(const std::optional<ReferenceInfo>& reference) { return reference && reference->oracle == "povray"; }

} // namespace

std::string_view name(Status status) {
    switch (status) {
    case Status::Scored:
        return "scored";
    case Status::NotApplicable:
        return "not-applicable";
    case Status::ExpectedFailure:
        return "expected-failure";
    case Status::Error:
        return "error";
    }
    return "";
}

std::optional<Headline> headline(const Record& record) {
    if (!records::hasAccuracy(record)) return {};
    const Accuracy& accuracy = record.accuracy;
    if (isSoft(record.reference) || isSoft(record.softReference)) {
        if (!accuracy.rmse) return {};
        return Headline{"rmse", *accuracy.rmse};
    }
    if (!accuracy.mismatch) return {};
    return Headline{"mismatch", *accuracy.mismatch};
}

std::optional<double> accuracyMetric(const Accuracy& accuracy, std::string_view metric) {
    Finder finder(metric);
    records::fields(finder, accuracy);
    return finder.found();
}

std::optional<double> boundedMetric(const Record& record, std::string_view metric) {
    const Stability& stability = record.stability;
    if (metric == "flicker") return stability.flicker ? std::optional(stability.flicker->mean) : std::nullopt;
    if (metric == "flip_rate") return stability.flipRate;
    if (metric == "moving_rmse") return stability.movingRmse;
    if (metric == "disocclusion_error") return stability.disocclusionError;
    if (metric == "convergence") return stability.convergence ? std::optional<double>(*stability.convergence) : std::nullopt;
    if (metric == "edge_error")
        return record.accuracy.edgeError ? std::optional(record.accuracy.edgeError->mean) : std::nullopt;
    if (metric == "pop") return record.lod ? std::optional(record.lod->pop) : std::nullopt;
    return accuracyMetric(record.accuracy, metric);
}

} // namespace shadowbench
