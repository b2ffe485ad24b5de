#include "studies/recommend/least_resource.h"

#include "base/error.h"
#include "report/summary.h"
#include "studies/sweep/variants.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <map>
#include <string_view>
#include <tuple>

namespace shadowbench::recommend {
namespace {

std::vector<std::string> parametersOf(Resource resource) {
    if (resource == Resource::MapTexels) return {"map"};
    return {"n", "taps"};
}

/// The values that are tried of a declared parameter.
std::vector<std::string> triedValues(const techniques::Parameter& parameter) {
    if (const auto* words = std::get_if<techniques::OneOf>(&parameter.domain)) return words->values;
    const auto* range = std::get_if<techniques::IntegerRange>(&parameter.domain);
    if (range == nullptr) return {};
    static constexpr int leastMap = 256, mostMap = 4096, leastSamples = 4, mostSamples = 256;
    const bool map = parameter.name == "map";
    std::vector<std::string> values;
    for (int value = map ? leastMap : leastSamples; value <= (map ? mostMap : mostSamples); value *= 2)
        if (value >= range->low && value <= range->high) values.push_back(std::to_string(value));
    return values;
}

/// One technique at one amount.
struct Step {
    double amount;
    double error;
    bool adequate;
    std::string variant;
};

/// What distinguishes curves: the technique and all its parameters but the one that the resource is.
std::string curveOf(const Record& record, const std::string& parameter) {
    std::string curve = record.technique;
    for (const auto& [name, value] : record.parameters) curve += "," + name + "=" + (name == parameter ? "" : value);
    return curve;
}

bool hasTwoAmounts(const std::vector<Step>& curve) {
    const auto [least, most] = std::ranges::minmax(curve, {}, &Step::amount);
    return least.amount < most.amount;
}

/// From the largest amount down to the last one that is adequate.
std::optional<Least> leastOf(std::vector<Step> curve) {
    std::ranges::sort(curve, std::greater<>(), &Step::amount);
    std::optional<Least> least;
    for (const Step& step : curve) {
        if (!step.adequate) break;
        least = Least{step.variant, step.amount, step.error};
    }
    return least;
}

/// By the first tolerance whose metric the record has.
std::optional<double> firstError(const Record& record, const std::vector<report::Tolerance>& limits) {
    for (const report::Tolerance& limit : limits)
        if (const auto error = metrics::bounded(record.values, limit.metric)) return error;
    return std::nullopt;
}

const char* parameterWords(Resource resource) {
    return resource == Resource::MapTexels ? "the size of a map" : "the number of samples";
}

} // namespace

std::optional<double> amount(Resource resource, const std::string& parameter, const std::string& value) {
    const std::vector<std::string> names = parametersOf(resource);
    if (std::ranges::find(names, parameter) == names.end()) return {};
    double sum = 0;
    std::string_view rest = value;
    while (!rest.empty()) {
        const std::string_view part = rest.substr(0, rest.find('+'));
        double number = 0;
        if (std::from_chars(part.data(), part.data() + part.size(), number).ptr != part.data() + part.size()) return {};
        sum += number;
        rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    }
    return sum;
}

std::vector<std::string> variantsOver(Resource resource, const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const std::string& pattern : patterns.empty() ? std::vector<std::string>{"*"} : patterns)
        for (const techniques::Variant& variant : techniques::matchVariants(pattern))
            for (const std::string& name : parametersOf(resource)) {
                const techniques::Parameter* parameter = parameterOf(variant, name);
                if (parameter == nullptr) continue;
                for (const std::string& value : triedValues(*parameter)) {
                    const std::string full = withParameter(variant, name, value).name;
                    if (std::ranges::find(names, full) == names.end()) names.push_back(full);
                }
            }
    if (names.empty())
        throw BadInput(fmt::format("none of the chosen techniques has a parameter for {}: choose others with --technique",
                                   parameterWords(resource)));
    return names;
}

std::vector<Least> leastAdequate(const std::vector<Record>& records, const std::string& scene, Resource resource) {
    const std::vector<report::Tolerance> limits = report::tolerances(records, scene);
    if (limits.empty()) return {};
    std::map<std::string, std::vector<Step>> curves;
    for (const std::size_t i : report::ofScene(records, scene)) {
        const Record& record = records[i];
        const std::optional<double> error = firstError(record, limits);
        if (!wasScored(record.status) || !error) continue;
        for (const auto& [name, value] : record.parameters)
            if (const auto much = amount(resource, name, value))
                curves[curveOf(record, name)].push_back({*much, *error, report::isWithin(record, limits), record.variant});
    }
    std::erase_if(curves, [](const auto& curve) { return !hasTwoAmounts(curve.second); });
    if (curves.empty())
        throw BadInput(
            fmt::format("the records of scene {} hold no technique that differs in {} alone: let the cells be run, "
                        "or give records of a sweep",
                        scene, parameterWords(resource)));
    std::vector<Least> all;
    for (auto& [curve, steps] : curves)
        if (auto least = leastOf(std::move(steps))) all.push_back(std::move(*least));
    std::ranges::sort(all, {}, [](const Least& least) { return std::tuple(least.amount, least.error, least.variant); });
    return all;
}

} // namespace shadowbench::recommend
