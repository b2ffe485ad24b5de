#include "harness/records/record.h"

#include "harness/records/fields.h"

namespace shadowbench {
namespace {

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

bool wasScored(Status status) { return status == Status::Scored || status == Status::ExpectedFailure; }

bool isLevelOfDetail(const Record& record) { return record.values["lod.pop"].has_value(); }

bool isExternal(const Record& record) { return record.technique.starts_with(externalPrefix); }

const std::string& revisionOf(const Record& record) {
    return record.external && !record.external->revision.empty() ? record.external->revision : record.commit;
}

std::optional<Headline> headline(const Record& record) {
    if (!records::hasAccuracy(record)) return {};
    const bool labels = record.values["accuracy.mismatch"].has_value();
    const bool soft = isSoft(record.reference) || isSoft(record.softReference);
    const std::string metric = soft || !labels ? "rmse" : "mismatch";
    const metrics::Values& values = record.values;
    for (const auto& mean : {values["views.mean"], values["stability.seeds.mean"]})
        if (mean) return Headline{metric, *mean};
    const std::optional<double> value = metrics::bounded(values, metric);
    return value ? std::optional(Headline{metric, *value}) : std::nullopt;
}

} // namespace shadowbench
