#include "report/modelled_costs.h"

#include "report/costing.h"
#include "report/text_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

using Term = double PassTerms::*;

double lowerBound(const PassTerms& pass) {
    return std::max({pass.texture, pass.output, pass.geometry, pass.memory}) + pass.fixed;
}

double milliseconds(const PassTerms& pass) { return std::max(lowerBound(pass), pass.arithmetic + pass.fixed); }

std::vector<PassTerms> ownPasses(const ModelledCost& cost) {
    std::vector<PassTerms> own = cost.passes;
    std::erase_if(own, [](const PassTerms& pass) { return pass.name == "G-buffer"; });
    return own;
}

/// What the technique's passes take as a multiple of what they would take without arithmetic.
std::string timesBound(const ModelledCost& cost) {
    double all = 0, least = 0;
    for (const PassTerms& pass : ownPasses(cost)) {
        all += milliseconds(pass);
        least += lowerBound(pass);
    }
    return cost.waits || least <= 0 ? "–" : fmt::format("{:.2f}", all / least);
}

/// "resolve: texture": the technique's longest pass and its largest term.
std::string limitOf(const ModelledCost& cost) {
    if (cost.waits) return "waits for the program";
    const std::vector<PassTerms> own = ownPasses(cost);
    if (own.empty()) return "–";
    static constexpr std::pair<const char*, Term> terms[] = {
        {"arithmetic", &PassTerms::arithmetic}, {"texture", &PassTerms::texture}, {"output", &PassTerms::output},
        {"geometry", &PassTerms::geometry},     {"memory", &PassTerms::memory},   {"fixed", &PassTerms::fixed}};
    const PassTerms& pass = *std::ranges::max_element(own, {}, milliseconds);
    const auto& largest = *std::ranges::max_element(terms, {}, [&](const auto& term) { return pass.*term.second; });
    return fmt::format("{}: {}", pass.name, largest.first);
}

/// The place of each cost from the cheapest, 1, on; 0 where one of a row's costs is missing.
std::vector<std::size_t> places(const std::vector<std::vector<double>>& rows, std::size_t column) {
    std::vector<std::size_t> result;
    for (const std::vector<double>& row : rows)
        result.push_back(row.empty() ? 0 : 1 + static_cast<std::size_t>(std::ranges::count_if(rows, [&](const auto& other) {
                                               return !other.empty() && other[column] < row[column];
                                           })));
    return result;
}

/// The costs of a row: where it was measured, then as it is modelled; empty unless it has all.
std::vector<double> allCosts(const Record& record, const std::vector<CostOf>& of) {
    std::vector<double> costs;
    for (const CostOf& each : of)
        if (const std::optional<FrameCost> cost = each(record)) costs.push_back(cost->ratio);
    return costs.size() == of.size() ? costs : std::vector<double>();
}

std::string withPlace(const std::optional<FrameCost>& cost, std::size_t place) {
    if (!cost) return "–";
    return place == 0 ? fmt::format("{:.2f}", cost->ratio) : fmt::format("{:.2f} ({})", cost->ratio, place);
}

} // namespace

std::string modelledTable(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<std::string> names = modelledNames(records, scene);
    if (names.empty()) return "";
    std::vector<CostOf> costs{standingCost};
    TextTable table{{"technique", "standing here, × (place)"}, {}};
    for (const std::string& name : names) {
        costs.push_back(modelledOn(name).standing);
        table.titles.insert(table.titles.end(),
                            {fmt::format("ms on {} (place)", cardAndSize(name)), "limited by", "× bound"});
    }
    std::vector<const Record*> rows;
    for (const std::size_t i : scoredOf(records, scene))
        if (records[i].modelled.contains(names.front())) rows.push_back(&records[i]);
    std::ranges::stable_sort(rows, {}, [&](const Record* row) { return row->modelled.at(names.front()).milliseconds; });
    std::vector<std::vector<double>> all;
    for (const Record* row : rows) {
        all.push_back(allCosts(*row, costs));
        table.rows.push_back({row->variant});
    }
    for (std::size_t column = 0; column < costs.size(); ++column) {
        const std::vector<std::size_t> order = places(all, column);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            table.rows[i].push_back(withPlace(costs[column](*rows[i]), order[i]));
            if (column == 0) continue;
            const auto found = rows[i]->modelled.find(names[column - 1]);
            const bool known = found != rows[i]->modelled.end();
            table.rows[i].push_back(known ? limitOf(found->second) : "–");
            table.rows[i].push_back(known ? timesBound(found->second) : "–");
        }
    }
    return markdown(table);
}

} // namespace shadowbench::report
