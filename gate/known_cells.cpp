#include "gate/known_cells.h"

#include "base/hash.h"
#include "techniques/variant_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace shadowbench::gate {
namespace {

constexpr std::size_t oneOf = 32; // known results is measured

/// A step whatever its techniques are.
std::string placeOf(const Step& step) {
    return fmt::format("{}\n{}\n{}", step.name, fmt::join(step.arguments, "\n"), step.inputs);
}

const std::string& techniqueOf(const Record& record) { return record.sweep ? record.sweep->curve : record.variant; }

std::map<std::string, std::vector<Record>> byTechnique(const std::vector<Record>& records) {
    std::map<std::string, std::vector<Record>> all;
    for (const Record& record : records) all[techniqueOf(record)].push_back(record);
    return all;
}

std::string resultOf(Record record) {
    record.commit = record.program = record.time = "";
    record.dirty = false;
    record.values["cost.instructions"].reset();
    return toJson(record);
}

} // namespace

bool isKnown(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head, const std::string& variant,
             const std::string& scene) {
    if (!base || !head) return false;
    const std::string technique(techniques::idOfVariant(variant));
    const auto before = base->reach.key(technique, scene), now = head->reach.key(technique, scene);
    return before && before == now;
}

KnownCells::KnownCells(const std::optional<BuildInfo>& base, const std::optional<BuildInfo>& head,
                       const std::vector<Step>& steps, const Measured& measured)
    : head_(head) {
    for (std::size_t i = 0; i < steps.size(); ++i)
        for (auto& [technique, records] : byTechnique(measured.ofSteps[i])) {
            const bool failed = std::ranges::any_of(records, [](const Record& r) { return r.status == Status::Error; });
            if (!failed && isKnown(base, head, technique, steps[i].scene))
                known_[placeOf(steps[i])].emplace(technique, records);
        }
}

const std::vector<Record>* KnownCells::find(const Step& step, const std::string& technique) const {
    const auto place = known_.find(placeOf(step));
    if (place == known_.end()) return nullptr;
    const auto records = place->second.find(technique);
    return records == place->second.end() ? nullptr : &records->second;
}

KnownCells::Split KnownCells::split(const std::vector<Step>& steps) const {
    Split split;
    std::vector<std::pair<std::string, std::pair<std::size_t, std::string>>> lots;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        split.steps.push_back(steps[i]);
        split.steps[i].techniques.clear();
        for (const std::string& technique : steps[i].techniques)
            if (find(steps[i], technique) != nullptr)
                lots.emplace_back(hash128(head_->commit + placeOf(steps[i]) + technique).text(), std::pair(i, technique));
            else
                split.steps[i].techniques.push_back(technique);
        split.reached += split.steps[i].techniques.size();
    }
    split.known = lots.size();
    split.sampled = (lots.size() + oneOf - 1) / oneOf;
    std::ranges::sort(lots);
    for (std::size_t i = 0; i < split.sampled; ++i)
        split.steps[lots[i].second.first].techniques.push_back(lots[i].second.second);
    std::erase_if(split.steps, [](const Step& step) { return step.techniques.empty(); });
    return split;
}

std::optional<std::string> KnownCells::contradicted(const std::vector<Step>& ran, const Measured& measured) const {
    for (std::size_t i = 0; i < ran.size(); ++i)
        for (const auto& [technique, records] : byTechnique(measured.ofSteps[i])) {
            const std::vector<Record>* base = find(ran[i], technique);
            if (base != nullptr && !std::ranges::equal(*base, records, {}, resultOf, resultOf))
                return fmt::format("{} on {}", technique, ran[i].scene);
        }
    return std::nullopt;
}

std::vector<Record> KnownCells::whole(const Step& step, const std::vector<Step>& ran, const Measured& measured) const {
    const auto same = std::ranges::find(ran, placeOf(step), placeOf);
    const auto now = same == ran.end() ? std::map<std::string, std::vector<Record>>{}
                                       : byTechnique(measured.ofSteps[static_cast<std::size_t>(same - ran.begin())]);
    std::vector<Record> all;
    for (const std::string& technique : step.techniques) {
        if (const auto found = now.find(technique); found != now.end()) {
            all.insert(all.end(), found->second.begin(), found->second.end());
        } else if (const std::vector<Record>* base = find(step, technique)) {
            for (Record record : *base) {
                record.commit = head_->commit;
                record.dirty = head_->dirty;
                record.program = head_->program;
                all.push_back(std::move(record));
            }
        }
    }
    return all;
}

} // namespace shadowbench::gate
