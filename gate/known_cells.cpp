#include "gate/known_cells.h"

#include "base/hash.h"
#include "scene/load/load.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace shadowbench::gate {
namespace {

constexpr std::size_t oneOf = 64; // known results is measured

std::string resultOf(Record record) {
    record.commit = record.program = record.time = "";
    record.dirty = false;
    return toJson(record);
}

std::size_t resultsIn(const std::vector<Step>& steps) {
    std::size_t all = 0;
    for (const Step& step : steps) all += step.techniques.size();
    return all;
}

} // namespace

bool isKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::string& variant,
             const std::string& scene) {
    if (!base || !head) return false;
    const std::string technique(techniques::idOfVariant(variant));
    const auto before = base->reach.key(technique, scene), now = head->reach.key(technique, scene);
    return before && before == now;
}

bool hasKnownShaders(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head,
                     const std::string& variant) {
    if (!base || !head) return false;
    const auto before = base->reach.hash(Reach::shaderFigures), now = head->reach.hash(Reach::shaderFigures);
    return before && before == now && std::ranges::all_of(builtinScenes(), [&](const std::string& scene) {
               return isKnown(base, head, variant, scene);
           });
}

std::vector<Step> sampleOfKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head,
                                const std::vector<Step>& steps) {
    std::vector<Step> sample = steps;
    for (Step& step : sample) {
        std::ranges::replace(step.arguments, std::string("instructions"), std::string("none"));
        std::erase_if(step.techniques, [&](const std::string& t) { return !isKnown(base, head, t, step.scene); });
    }
    const std::size_t drawn = (resultsIn(sample) + oneOf - 1) / oneOf;
    std::vector<std::pair<std::string, std::pair<std::size_t, std::string>>> lots;
    for (std::size_t i = 0; i < sample.size(); ++i)
        for (const std::string& technique : std::exchange(sample[i].techniques, {}))
            lots.emplace_back(hash128(head->commit + sample[i].place() + technique).text(), std::pair(i, technique));
    std::ranges::sort(lots);
    for (std::size_t i = 0; i < drawn; ++i) sample[lots[i].second.first].techniques.push_back(lots[i].second.second);
    std::erase_if(sample, [](const Step& step) { return step.techniques.empty(); });
    return sample;
}

std::optional<std::string> contradicted(const std::vector<Step>& sample, const Measured& base, const Measured& head) {
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const auto before = byTechnique(base.ofSteps[i]), now = byTechnique(head.ofSteps[i]);
        for (const std::string& technique : sample[i].techniques) {
            const auto was = before.find(technique), is = now.find(technique);
            const bool same = was != before.end() && is != now.end() &&
                              std::ranges::equal(was->second, is->second, {}, resultOf, resultOf);
            if (!same) return fmt::format("{} on {}", technique, sample[i].scene);
        }
    }
    return std::nullopt;
}

} // namespace shadowbench::gate
