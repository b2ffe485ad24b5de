#include "report/advice.h"

#include "report/costing.h"
#include "techniques/catalog.h"
#include "techniques/contract/entry.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <tuple>

namespace shadowbench::report {
namespace {

/// Half an interval of a cost, as a share of it, from which on the cost ranks nothing.
constexpr double widestSpread = 0.5;

constexpr double frameMilliseconds = 1000.0 / 60; // at 60 Hz

/// By cost, then error; those that were not timed last.
std::tuple<double, double> rank(const Record& record, const CostOf& costOf) {
    const std::optional<Place> here = place(record, costOf);
    return {here ? here->cost : std::numeric_limits<double>::infinity(), headline(record)->value};
}

bool isUncertain(const Place& place) { return place.costSpread > widestSpread; }

bool overlap(const Place& a, const Place& b) {
    return a.cost * (1 - a.costSpread) <= b.cost * (1 + b.costSpread) &&
           b.cost * (1 - b.costSpread) <= a.cost * (1 + a.costSpread);
}

} // namespace

std::set<Need> lackedOf(const Record& record, const std::set<Need>& needs) {
    const auto all = techniques::catalog();
    const auto entry = std::ranges::find(all, record.technique, &techniques::Entry::id);
    std::set<Need> lacked;
    if (entry != all.end()) std::ranges::set_intersection(lacking(*entry), needs, std::inserter(lacked, lacked.end()));
    return lacked;
}

Advice adviceFor(const std::vector<Record>& records, const std::string& scene, const std::set<Need>& needs) {
    const std::vector<Tolerance> limits = tolerances(records, scene);
    const Costing costing = shownCosting(records, scene);
    const auto placeOf = [&](std::size_t i) {
        std::optional<Place> found = place(records[i], costing.of);
        if (found) found->costSpread = std::max(found->costSpread, costing.spread);
        return found;
    };
    Advice advice;
    for (const std::size_t i : ofScene(records, scene)) {
        const Record& record = records[i];
        if (isBaseline(record) || !isWithin(record, limits)) continue;
        if (isExternal(record))
            advice.external.push_back(i);
        else
            (lackedOf(record, needs).empty() ? advice.within : advice.unsuited).push_back(i);
    }
    std::ranges::stable_sort(advice.within, {}, [&](std::size_t i) { return rank(records[i], costing.of); });
    for (const std::size_t i : advice.within) {
        const std::optional<Place> here = placeOf(i);
        if (!here) continue;
        if (isUncertain(*here))
            advice.uncertain.push_back(i);
        else if (!advice.take)
            advice.take = i;
        else if (overlap(*here, *placeOf(*advice.take)))
            advice.asCheap.push_back(i);
    }
    advice.fitsNoFrame = advice.take && !costing.card.empty() && placeOf(*advice.take)->cost > frameMilliseconds;
    return advice;
}

std::vector<std::string> notesOn(const Advice& advice, const std::vector<Record>& records, const std::set<Need>& needs) {
    std::vector<std::string> notes;
    if (advice.fitsNoFrame) notes.push_back("no technique within tolerance is modelled to fit a frame at 60 Hz");
    if (!advice.asCheap.empty())
        notes.push_back("as cheap, as far as the times tell: " + variantsOf(records, advice.asCheap));
    if (!advice.uncertain.empty())
        notes.push_back(
            fmt::format("within tolerance, but timed too unsteadily to rank: {}", variantsOf(records, advice.uncertain)));
    std::map<std::set<Need>, std::vector<std::size_t>> byLack;
    for (const std::size_t i : advice.unsuited) byLack[lackedOf(records[i], needs)].push_back(i);
    for (const auto& [lacked, rows] : byLack)
        notes.push_back(
            fmt::format("within tolerance here, but not for {}: {}", namesOf(lacked), variantsOf(records, rows)));
    if (!advice.external.empty())
        notes.push_back(
            fmt::format("within tolerance, at a cost that is not measured here: {}", variantsOf(records, advice.external)));
    return notes;
}

std::optional<CommonAdvice> commonAdvice(const std::vector<Record>& records, const std::vector<std::string>& scenes,
                                         const std::set<Need>& needs) {
    std::set<std::string> cards;
    for (const std::string& scene : scenes) cards.insert(shownCosting(records, scene).card);
    const Costing costing =
        cards.size() == 1 && !cards.begin()->empty() ? modelledOn(*cards.begin()) : measuredHere(records, scenes.front());
    std::map<std::string, CommonAdvice> common; // by variant, of those within on all scenes so far
    for (const std::string& scene : scenes) {
        std::map<std::string, CommonAdvice> still;
        for (const std::size_t i : adviceFor(records, scene, needs).within) {
            const std::string& variant = records[i].variant;
            const std::optional<FrameCost> cost = costing.of(records[i]);
            if (!cost || (&scene != &scenes.front() && !common.contains(variant))) continue;
            CommonAdvice advice = common.contains(variant) ? common[variant] : CommonAdvice{variant, scene, 0, costing.card};
            if (cost->ratio > advice.cost) advice = {variant, scene, cost->ratio, costing.card};
            still[variant] = advice;
        }
        common = std::move(still);
    }
    const auto least =
        std::ranges::min_element(common, {}, [](const auto& entry) { return std::tuple(entry.second.cost, entry.first); });
    return least == common.end() ? std::nullopt : std::optional(least->second);
}

} // namespace shadowbench::report
