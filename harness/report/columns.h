// The columns of a scene's tables beside technique, error and front.
#pragma once

#include "harness/metrics/values.h"

#include <span>
#include <string>

namespace shadowbench::report {

struct Column {
    const char* title;
    bool pageOnly; // the terminal has no room for it
    metrics::MetricId metric;
    std::string (*format)(double);
};
std::span<const Column> columns();

} // namespace shadowbench::report
