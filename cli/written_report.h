// The lines that say where a report lies.
#pragma once

#include "report/run_report.h"

#include <fmt/format.h>

namespace shadowbench {

inline void printFiles(const report::Written& written) {
    fmt::print("page: {}\n", written.page.string());
    if (!written.charts.empty())
        fmt::print("charts: {} in {}\n", written.charts.size(), written.page.parent_path().string());
}

} // namespace shadowbench
