#include "harness/cells/neighbours.h"

#include "base/error.h"
#include "harness/cells/cell.h"
#include "harness/cells/image_scores.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <string>

namespace shadowbench {
namespace {

/// What scoredError would draw again.
std::optional<double> errorIn(const Record& record, Truth truth) {
    return truth == Truth::Hard ? record.values["accuracy.mismatch"] : record.values["accuracy.rmse"];
}

/// From the record's error to the neighbour's.
std::optional<double> stepTo(SceneFrames& there, const techniques::Variant& neighbour, std::uint32_t seed,
                             const Record& record) {
    const Truth truth = mainTruth(there.scene(), neighbour);
    const std::optional<double> own = errorIn(record, truth), error = scoredError(there, neighbour, seed, truth);
    return own && error ? std::optional(stepBetween(truth, *own, *error)) : std::nullopt;
}

} // namespace

std::optional<techniques::Variant> withNeighbourMap(const techniques::Variant& variant) {
    const std::vector<techniques::Parameter>& declared = variant.entry->parameters;
    const auto map = std::ranges::find(declared, "map", &techniques::Parameter::name);
    if (map == declared.end()) return std::nullopt;
    std::string text;
    for (const auto& [name, value] : variant.parameters.all())
        text += fmt::format("{}{}={}", text.empty() ? "" : ",", name,
                            name == "map" ? std::to_string(neighbourOf(variant.parameters.integer("map"))) : value);
    try {
        return techniques::parseVariant(variant.entry->id + ":" + text);
    } catch (const BadInput&) { // beyond its range, or no size that goes with the other values
        return std::nullopt;
    }
}

double stepBetween(Truth truth, double error, double neighbour) {
    const double least = truth == Truth::Hard ? 0.001 : 0.005;
    const auto [low, high] = std::minmax(std::max(error, least), std::max(neighbour, least));
    return high / low;
}

void scoreNeighbourMap(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, Record& record) {
    if (const auto neighbour = withNeighbourMap(variant))
        record.values["sanity.map_step"] = stepTo(frames, *neighbour, seed, record);
}

void scoreNeighbourImage(SceneFrames& larger, const techniques::Variant& variant, std::uint32_t seed, Record& record) {
    record.values["sanity.image_step"] = stepTo(larger, variant, seed, record);
}

void scoreViews(const Scene& scene, const std::vector<std::unique_ptr<ChangedScene>>& others,
                const techniques::Variant& variant, std::uint32_t seed, Record& record) {
    if (variant.entry->temporal) return;
    const Truth truth = gradedTruth(scene);
    std::vector<double> errors;
    const auto add = [&](const std::optional<double>& error) {
        if (error) errors.push_back(*error);
    };
    add(errorIn(record, truth));
    for (const auto& other : others) add(scoredError(other->frames(), variant, seed, truth));
    if (errors.size() < 2) return;
    record.values["views.mean"] = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    record.values["views.worst"] = *std::ranges::max_element(errors);
    record.values.list("views.errors") = std::move(errors);
}

} // namespace shadowbench
