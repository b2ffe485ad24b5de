// A sweep as a table: a row a technique, a column a value, and where it breaks.
#include "report/run_report.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

std::vector<double> valuesOf(const std::vector<Record>& records) {
    std::vector<double> values;
    for (const Record& record : records)
        if (std::ranges::find(values, record.sweep->value) == values.end()) values.push_back(record.sweep->value);
    return values;
}

std::string cell(const Record& record, const std::string& metric) {
    if (record.status == Status::Error) return "error";
    const std::optional<double> error =
        record.status == Status::Scored ? metrics::bounded(record.values, metric) : std::nullopt;
    return error ? formatValue(metric, *error) : "–";
}

} // namespace

std::string sweepTable(const std::vector<Record>& records) {
    const std::string& scene = records.front().scene;
    const std::optional<Tolerance> limit = tolerance(records, scene);
    const std::string metric = limit ? limit->metric : headlineMetric(records, scene);
    const SweepStep& first = *records.front().sweep;
    std::string header =
        fmt::format("| {} |", first.unit.empty() ? first.axis : fmt::format("{} [{}]", first.axis, first.unit));
    std::string rule = "|---|";
    for (const double value : valuesOf(records)) {
        header += fmt::format(" {} |", value);
        rule += "--:|";
    }
    std::string text = fmt::format("{}: {}{}\n\n{} breaks at |\n{}--:|\n", scene, meaning(metric),
                                   limit ? ", tolerance " + formatBound(*limit) : "", header, rule);
    std::string curve;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const SweepStep& step = *records[i].sweep;
        if (step.curve != curve) text += fmt::format("| {} |", markdownText(curve = step.curve));
        text += fmt::format(" {} |", cell(records[i], metric));
        if (i + 1 == records.size() || records[i + 1].sweep->curve != curve)
            text += step.breakPoint ? fmt::format(" {} |\n", *step.breakPoint) : " – |\n";
    }
    return text;
}

} // namespace shadowbench::report
