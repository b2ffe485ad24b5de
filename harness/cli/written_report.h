// What a person is told about a report's files.
#pragma once

#include "harness/report/run_report.h"

#include <fmt/format.h>

namespace shadowbench {

inline void print(const report::Written& written) {
    fmt::print("page: {}\n", written.page.string());
    for (const std::filesystem::path& chart : written.charts) fmt::print("chart: {}\n", chart.string());
}

} // namespace shadowbench
