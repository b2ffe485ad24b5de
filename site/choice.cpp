#include "site/choice.h"

#include "report/advice.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace shadowbench::site {
namespace {

using report::Tolerance;

std::optional<std::size_t> least(const std::vector<Record>& records, const std::vector<std::size_t>& among,
                                 const std::vector<Tolerance>& limits) {
    const auto rank = [&](std::size_t i) {
        const double error = headline(records[i])->value;
        return std::tuple(report::shareOfTolerance(records[i], limits).value_or(error), error);
    };
    const auto best = std::ranges::min_element(among, {}, rank);
    return best == among.end() ? std::nullopt : std::optional(*best);
}

} // namespace

std::vector<std::size_t> suitedOn(const std::vector<Record>& records, const std::string& scene) {
    std::vector<std::size_t> suited = report::scoredOf(records, scene);
    std::erase_if(suited, [&](std::size_t i) {
        return report::isBaseline(records[i]) || isExternal(records[i]) ||
               !report::lackedOf(records[i], techniques::usualNeeds()).empty();
    });
    return suited;
}

Choice choiceFor(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<Tolerance> limits = report::tolerances(records, scene);
    const report::Advice advice = report::adviceFor(records, scene);
    const std::vector<std::size_t> suited = suitedOn(records, scene);
    Choice choice{.take = advice.take, .adequate = !advice.within.empty(), .why = {}, .others = advice.within, .notes = {}};
    if (choice.take)
        choice.why = fmt::format("cheapest of {} within tolerance{}", advice.within.size(),
                                 advice.fitsNoFrame ? ", of which none is modelled to fit a frame at 60 Hz" : "");
    else if (choice.adequate)
        choice.why = fmt::format("least error of {} within tolerance; none was timed", advice.within.size());
    else if (!suited.empty())
        choice.why = "none is within tolerance; this one is nearest";
    else
        choice.why = "no technique that can do what is usually needed was scored";
    if (!choice.take) choice.take = least(records, choice.adequate ? advice.within : suited, limits);
    std::erase_if(choice.others, [&](std::size_t i) { return i == choice.take; });
    choice.notes = report::notesOn(advice, records, techniques::usualNeeds());
    return choice;
}

std::string errorText(const Record& record) { return headline(record) ? report::errorText(record) : "–"; }

} // namespace shadowbench::site
