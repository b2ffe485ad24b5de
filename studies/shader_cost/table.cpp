#include "report/text_table.h"
#include "studies/shader_cost/compared.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::shaders {
namespace {

struct Column {
    const char* title;
    std::vector<std::string> statistics; // added up
};

/// Of what the compiler gives, what decides first.
const std::vector<Column>& columns() {
    static const std::vector<Column> all{{"instructions", {"Instructions"}},
                                         {"VGPRs", {"VGPRs"}},
                                         {"waves", {"Subgroups per SIMD"}},
                                         {"branches", {"Branches"}},
                                         {"spills", {"Spilled VGPRs", "Spilled SGPRs"}},
                                         {"latency", {"Latency"}},
                                         {"inverse throughput", {"Inverse Throughput"}}};
    return all;
}

std::uint64_t sumOf(const Column& column, const ShaderCost& shader) {
    std::uint64_t sum = 0;
    for (const std::string& statistic : column.statistics) sum += shader.of(statistic);
    return sum;
}

/// "726/701/698"; "0" where all are alike.
std::string figure(const Column& column, const std::vector<const ShaderCost*>& shader) {
    std::vector<std::uint64_t> values;
    for (const ShaderCost* on : shader) values.push_back(sumOf(column, *on));
    if (std::ranges::adjacent_find(values, std::ranges::not_equal_to()) == values.end())
        return fmt::format("{}", values.front());
    return fmt::format("{}", fmt::join(values, "/"));
}

/// Likewise of what waves of 64 execute; "–" where nothing counted.
std::string executedFigure(const std::vector<const ShaderCost*>& shader) {
    std::vector<std::string> values;
    for (const ShaderCost* on : shader) values.push_back(on->executed ? fmt::format("{:.0f}", on->executed->cycles64) : "–");
    if (std::ranges::adjacent_find(values, std::ranges::not_equal_to()) == values.end()) return values.front();
    return fmt::format("{}", fmt::join(values, "/"));
}

std::string step(const std::string& before, const std::string& after) {
    return before == after ? after : fmt::format("{} → {}", before, after);
}

} // namespace

std::string beforeAndAfter(const SharedShader& shader) {
    std::vector<std::string> parts;
    for (const Column& column : columns())
        parts.push_back(
            fmt::format("{} {}", column.title,
                        step(std::to_string(sumOf(column, *shader.before)), std::to_string(sumOf(column, *shader.after)))));
    if (shader.isCounted())
        parts.push_back(fmt::format("executed {}", step(fmt::format("{:.1f}", shader.before->executed->cycles64),
                                                        fmt::format("{:.1f}", shader.after->executed->cycles64))));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string table(const ShaderCosts& costs) {
    std::vector<std::string> architectures;
    std::vector<std::pair<std::string, std::vector<const ShaderCost*>>> rows; // by name, in the order of the list
    std::map<std::string, std::size_t> known;
    for (const ShaderCost& shader : costs.shaders) {
        if (std::ranges::find(architectures, shader.architecture) == architectures.end())
            architectures.push_back(shader.architecture);
        const auto [entry, isNew] = known.try_emplace(shader.name(), rows.size());
        if (isNew) rows.emplace_back(shader.name(), std::vector<const ShaderCost*>());
        rows[entry->second].second.push_back(&shader);
    }
    report::TextTable text{{"shader"}, {}};
    for (const Column& column : columns()) text.titles.emplace_back(column.title);
    const bool isCounted =
        std::ranges::any_of(costs.shaders, [](const ShaderCost& each) { return each.executed.has_value(); });
    if (isCounted) text.titles.emplace_back("executed");
    for (const auto& [name, shader] : rows) {
        std::vector<std::string>& cells = text.rows.emplace_back(std::vector{name});
        for (const Column& column : columns()) cells.push_back(figure(column, shader));
        if (isCounted) cells.push_back(executedFigure(shader));
    }
    return fmt::format("{}; {}\n{}", fmt::join(architectures, "/"), costs.compiler, report::aligned(text));
}

} // namespace shadowbench::shaders
