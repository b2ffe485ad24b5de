// The columns of a scene's tables: those beside technique, error and front, and those of levels of detail.
#pragma once

#include "harness/records/record.h"
#include "report/text_table.h"

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
std::span<const Column> lodColumns();

/// Those of `columns` that apply to one of the records at least, in their order.
std::vector<const Column*> applying(std::span<const Column> columns, const std::vector<const Record*>& records);

/// Adds these to a table with a row for each of the records; "–" does not apply. `page`: those that a terminal has no room
/// for, too.
void addColumns(TextTable& table, std::span<const Column> columns, const std::vector<const Record*>& records, bool page);

} // namespace shadowbench::report
