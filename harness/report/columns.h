// The columns of a scene's tables beside technique, error and front.
#pragma once

#include "harness/records/record.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowbench::report {

struct Column {
    const char* title;
    bool pageOnly;            // the terminal has no room for it
    metrics::MetricId metric; // whose value is shown …
    std::string (*format)(double);
    std::optional<double> (*computed)(const Record&) = nullptr; // … unless it is one of several
    const char *key = "", *hint = "";                           // of what is computed

    [[nodiscard]] std::optional<double> of(const Record& record) const {
        return computed == nullptr ? record.values[metric] : computed(record);
    }
};
std::span<const Column> columns();

/// Those that apply to one of the records at `indices` at least, in their order.
std::vector<const Column*> columnsOf(const std::vector<Record>& records, const std::vector<std::size_t>& indices);

} // namespace shadowbench::report
