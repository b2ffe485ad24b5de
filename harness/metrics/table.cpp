#include "harness/metrics/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::metrics {
namespace {

// Every metric is compared, or says why not.
static_assert(std::ranges::all_of(table, [](const Metric& m) { return m.allowance.has_value() == m.notCompared.empty(); }));

// What an allowance counts pixels of has a line of its own.
static_assert(std::ranges::all_of(table, [](const Metric& m) {
    return !m.allowance || m.allowance->of.empty() || std::ranges::count(table, m.allowance->of, &Metric::path) == 1;
}));

// A metric that is compared or bounded says what it is about, and a name for bounds stands for one metric.
static_assert(std::ranges::all_of(table, [](const Metric& m) { return m.about || (!m.allowance && m.bound.empty()); }));
static_assert(std::ranges::all_of(table, [](const Metric& m) {
    return std::ranges::count(table, m.path, &Metric::path) == 1 &&
           (m.bound.empty() || std::ranges::count(table, m.bound, &Metric::bound) == 1);
}));

const Metric* found(std::string_view text, std::string_view Metric::*column) {
    const auto line = std::ranges::find(table, text, column);
    return line == table.end() || text.empty() ? nullptr : &*line;
}

} // namespace

std::string_view name(Class c) {
    switch (c) {
    case Class::Labels:
        return "labels";
    case Class::FalseShadow:
        return "false shadow";
    case Class::Leak:
        return "leak";
    case Class::Edge:
        return "edge";
    case Class::Penumbra:
        return "penumbra";
    case Class::Flicker:
        return "flicker";
    case Class::Colour:
        return "colour";
    case Class::BreakPoint:
        return "break point";
    case Class::Work:
        return "work";
    case Class::Instructions:
        return "instructions";
    case Class::Shader:
        return "shader";
    case Class::Time:
        return "time";
    case Class::Figure:
        return "figure";
    case Class::Status:
        return "status";
    }
    return "";
}

const Metric* metricAt(std::string_view path) { return found(path, &Metric::path); }

const Metric* boundedMetric(std::string_view name) { return found(name, &Metric::bound); }

const std::vector<std::string>& boundedMetrics() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Metric& line : table)
            if (!line.bound.empty()) all.emplace_back(line.bound);
        return all;
    }();
    return names;
}

std::string describe(const Allowance& allowance) {
    std::vector<std::string> parts;
    if (allowance.pixels > 0) {
        const std::string_view of = allowance.of.substr(allowance.of.rfind('.') + 1);
        parts.push_back(
            fmt::format("{}{}{} pixel{}", allowance.pixels, of.empty() ? "" : " ", of, allowance.pixels == 1 ? "" : "s"));
    }
    if (allowance.truth != TruthError::None) parts.emplace_back("the truth's own error");
    if (allowance.absolute > 0) parts.push_back(fmt::format("{}", allowance.absolute));
    std::string text = fmt::format("{}", fmt::join(parts, " or "));
    if (allowance.relative > 0) text += fmt::format("{}{:g} %", text.empty() ? "" : " + ", 100 * allowance.relative);
    return text.empty() ? "none" : text;
}

} // namespace shadowbench::metrics
