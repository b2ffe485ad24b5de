#include "harness/report/site/choice.h"

#include "harness/report/run_report.h"
#include "harness/report/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <tuple>

namespace shadowbench::site {
namespace {

using report::Tolerance;

/// By cost, then error; those that were not timed last.
std::tuple<double, double> rankByCost(const Record& record) {
    const auto place = report::place(record);
    return {place ? place->cost : std::numeric_limits<double>::infinity(), headline(record)->value};
}

std::optional<std::size_t> least(const std::vector<Record>& records, const std::vector<std::size_t>& among,
                                 const std::vector<Tolerance>& limits) {
    const auto rank = [&](std::size_t i) {
        const double error = headline(records[i])->value;
        return std::tuple(limits.empty() ? error : report::shareOfTolerance(records[i], limits).value_or(error), error);
    };
    const auto best = std::ranges::min_element(among, {}, rank);
    return best == among.end() ? std::nullopt : std::optional(*best);
}

} // namespace

Choice choiceFor(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<Tolerance> limits = report::tolerances(records, scene);
    std::vector<std::size_t> within = report::adequate(records, scene), scored = report::ofScene(records, scene);
    std::erase_if(within, [&](std::size_t i) { return report::isBaseline(records[i]); });
    std::erase_if(scored, [&](std::size_t i) { return report::isBaseline(records[i]) || !headline(records[i]); });

    Choice choice;
    choice.take = report::cheapestAdequate(records, scene);
    choice.adequate = !within.empty();
    if (choice.take)
        choice.why = fmt::format("cheapest of {} within tolerance", within.size());
    else if (!within.empty())
        choice.why = fmt::format("least error of {} within tolerance; none was timed", within.size());
    else if (!scored.empty())
        choice.why =
            limits.empty() ? "least error; the scene states no tolerance" : "none is within tolerance; this one is nearest";
    else
        choice.why = "no technique was scored";
    if (!choice.take) choice.take = least(records, within.empty() ? scored : within, limits);
    std::ranges::stable_sort(within, {}, [&](std::size_t i) { return rankByCost(records[i]); });
    std::erase_if(within, [&](std::size_t i) { return i == choice.take; });
    choice.others = within;
    return choice;
}

std::string errorText(const Record& record) { return headline(record) ? report::errorText(record) : "–"; }

} // namespace shadowbench::site
