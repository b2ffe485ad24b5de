#include "site/ship.h"

#include "report/summary.h"
#include "site/choice.h"
#include "site/multiples.h"
#include "site/scene_tables.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace shadowbench::site {
namespace {

/// A row on the scenes of one kind of light.
struct Candidate {
    std::vector<const Record*> within;
    std::vector<std::pair<double, std::string>> missed; // multiples of the tolerance and scenes
    std::optional<double> cost;
};

/// Scenes whose light has an area, or those whose light has none; of these, the ones on which a shadow map was scored.
std::vector<std::string> scenesOf(const std::vector<Record>& records, bool area) {
    std::vector<std::string> scenes;
    for (const std::string& scene : report::scenes(records)) {
        const std::vector<std::size_t> suited = suitedOn(records, scene);
        const bool answered = std::ranges::any_of(suited, [&](std::size_t i) { return records[i].variant == "sm-uniform"; });
        if (answered && (report::headlineMetric(records, scene) == "rmse") == area) scenes.push_back(scene);
    }
    return scenes;
}

std::map<std::string, Candidate> candidates(const std::vector<Record>& records, const std::vector<std::string>& scenes) {
    const Multiples costs(records);
    std::map<std::string, Candidate> all;
    for (const std::string& scene : scenes) {
        const std::vector<report::Tolerance> limits = report::tolerances(records, scene);
        for (const std::size_t i : suitedOn(records, scene)) {
            Candidate& candidate = all[records[i].variant];
            if (report::isWithin(records[i], limits))
                candidate.within.push_back(&records[i]);
            else if (const auto share = report::shareOfTolerance(records[i], limits))
                candidate.missed.emplace_back(*share, scene);
        }
    }
    for (auto& [variant, candidate] : all) {
        candidate.cost = costs.mean(variant, scenes);
        std::ranges::sort(candidate.missed, std::ranges::greater());
    }
    return all;
}

std::string worstOf(const Candidate& candidate) {
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, candidate.missed.size()); ++i)
        text +=
            fmt::format("{}{} {:.1f} ×", text.empty() ? "" : ", ", candidate.missed[i].second, candidate.missed[i].first);
    return text.empty() ? "–" : text;
}

} // namespace

Table shipTable(const std::vector<Record>& records, const std::filesystem::path& images) {
    static constexpr double factors[] = {1.25, 1.5, 2, 4};
    Table table{.id = "ship",
                .caption = "What to ship, by the scenes on which it is within tolerance",
                .columns = {{.title = "light", .number = false},
                            {.title = "for at most"},
                            {.title = "ship", .number = false},
                            {.title = "within", .hint = "Scenes on which it is within tolerance, of all under such lights"},
                            {.title = "cost", .hint = "Frames of sm-uniform, " + Multiples(records).where()},
                            {.title = "misses most", .hint = "Multiples of the tolerance", .number = false, .prose = true},
                            {.title = "its weakness", .number = false, .prose = true}},
                .rows = {},
                .headed = false};
    for (const bool area : {false, true}) {
        const std::vector<std::string> scenes = scenesOf(records, area);
        const std::map<std::string, Candidate> all = candidates(records, scenes);
        std::string shipped;
        for (const double factor : factors) {
            const auto rank = [&](const auto& entry) {
                const bool affordable = entry.second.cost && *entry.second.cost <= factor;
                return std::tuple(affordable ? entry.second.within.size() + 1 : 0, -entry.second.cost.value_or(0));
            };
            const auto best = std::ranges::max_element(all, {}, rank);
            if (best == all.end() || std::get<0>(rank(*best)) <= 1) continue;
            if (best->first == shipped) continue; // more buys nothing
            shipped = best->first;
            const Candidate& candidate = best->second;
            const Record& shown = *candidate.within.front();
            table.rows.push_back({{Cell{area ? "with an area" : "a point or a direction"},
                                   Cell{fmt::format("{:g} ×", factor), factor}, techniqueCell(shown, images),
                                   Cell{fmt::format("{} of {}", candidate.within.size(), scenes.size()),
                                        static_cast<double>(candidate.within.size())},
                                   Cell{fmt::format("{:.2f}", *candidate.cost), *candidate.cost},
                                   Cell{.text = worstOf(candidate), .kind = "small"},
                                   Cell{.text = report::admittedFailure(shown.technique), .kind = "small"}},
                                  {}});
        }
    }
    return table;
}

} // namespace shadowbench::site
