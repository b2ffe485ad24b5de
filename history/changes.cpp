#include "history/changes.h"

#include "gate/paired.h"
#include "harness/measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace shadowbench::history {
namespace {

std::vector<double> valuesOf(const Series& series) {
    std::vector<double> values;
    for (const Point& point : series.points) values.push_back(point.value);
    return values;
}

/// Noise is a factor: its figures are compared by their logarithms.
Noisy noisyOf(const Series& series, std::size_t first = 0) {
    Noisy figures;
    for (std::size_t i = first; i < series.points.size(); ++i) {
        figures.values.push_back(std::log(series.points[i].value));
        figures.commits.push_back(series.points[i].commit);
    }
    return figures;
}

std::vector<std::size_t> exactChanges(const Series& series) {
    std::vector<double> allowances;
    for (const Point& point : series.points) allowances.push_back(point.allowance);
    return levelChanges(valuesOf(series), allowances);
}

Level levelOf(const Series& series, std::size_t first, std::size_t end) {
    const std::vector<double> values = valuesOf(series);
    const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
    const double value = series.noisy ? timing::median({at(first), at(end)}) : values[first];
    return {series.points[first].commit, series.points[end - 1].commit, value, end - first};
}

bool isWithinFloor(const Level& a, const Level& b) {
    return std::abs(std::log(b.value / a.value)) <= std::log1p(gate::TimeRule{}.floor);
}

double allowanceAt(const Series& series, std::size_t commit) {
    return std::ranges::find(series.points, commit, &Point::commit)->allowance;
}

LevelChange changeBetween(const History& history, std::size_t index, const Level& before, const Level& after) {
    const Series& series = history.series[index];
    const double change = std::abs(after.value - before.value),
                 larger = std::max(std::abs(before.value), std::abs(after.value));
    const double allowance = std::max(allowanceAt(series, before.first), allowanceAt(series, after.first));
    const auto direction = after.value > before.value ? gate::Direction::Worse : gate::Direction::Better;
    return {index, before, after, direction, std::min(1.0, change / std::max(larger, 100 * allowance))};
}

/// The levels that begin at 0 and after each of `ends` but the last.
std::vector<Level> levelsBetween(const Series& series, std::vector<std::size_t> ends) {
    ends.push_back(series.points.size());
    std::vector<Level> levels;
    std::size_t start = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const Level level = levelOf(series, start, ends[i]);
        const bool last = i + 1 == ends.size();
        if (!last && series.noisy && isWithinFloor(level, levelOf(series, ends[i], ends[i + 1]))) continue;
        levels.push_back(level);
        start = ends[i];
    }
    return levels;
}

} // namespace

Levels levelsOf(const History& history, const NoiseRule& rule) {
    std::vector<Noisy> noisy;
    for (const Series& series : history.series)
        if (series.noisy) noisy.push_back(noisyOf(series));
    const NoiseChanges found = distributionChanges(noisy, rule);
    Levels result;
    auto next = found.changes.begin();
    for (const Series& series : history.series) {
        result.levels.push_back(levelsBetween(series, series.noisy ? *next++ : exactChanges(series)));
        result.smallest.emplace_back();
        if (!series.noisy) continue;
        const Noisy newest = noisyOf(series, series.points.size() - result.levels.back().back().figures);
        const auto rise = smallestRise(newest, std::log1p(gate::TimeRule{}.floor), found.leastRatio, rule);
        if (rise) result.smallest.back() = std::expm1(*rise);
    }
    return result;
}

std::vector<Event> eventsOf(const History& history) {
    const auto identity = [](const Series& s) { return std::tie(s.scene, s.metric, s.variant, s.cell); };
    const std::vector<Series>& all = history.series;
    std::vector<Event> events;
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        std::size_t last = first; // the series with the newest figure
        for (end = first; end < all.size() && identity(all[end]) == identity(all[first]); ++end) {
            const std::size_t since = all[end].points.front().commit;
            if (end > first) events.push_back({all[end].apart, end, since});
            if (end == first && since > 0) events.push_back({"began", end, since});
            if (all[end].points.back().commit >= all[last].points.back().commit) last = end;
        }
        const Point& newest = all[last].points.back();
        if (newest.commit + 1 < history.commits.size())
            events.push_back({"vanished", last, newest.commit});
        else if (all[last].metricClass == gate::Class::Status && newest.value > 0)
            events.push_back({"in error", last, newest.commit});
    }
    return events;
}

std::vector<LevelChange> changesBetween(const History& history, const std::vector<std::vector<Level>>& levels) {
    std::vector<LevelChange> changes;
    for (std::size_t i = 0; i < levels.size(); ++i)
        for (std::size_t k = 1; k < levels[i].size(); ++k)
            changes.push_back(changeBetween(history, i, levels[i][k - 1], levels[i][k]));
    std::ranges::stable_sort(changes, std::greater{}, &LevelChange::size);
    return changes;
}

std::vector<Suspects> suspectsOf(const History& history, const std::vector<LevelChange>& changes,
                                 const std::optional<Repository>& repository) {
    std::vector<Suspects> all;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const std::size_t old = changes[i].before.last, now = changes[i].after.first;
        auto found = std::ranges::find_if(all, [&](const Suspects& s) { return s.old == old && s.now == now; });
        if (found == all.end()) found = all.insert(all.end(), Suspects{old, now, 0, "", {}});
        found->changes.push_back(i);
    }
    if (!repository) return all;
    for (Suspects& suspects : all) {
        const std::string& old = history.commits[suspects.old].hash;
        const std::string& now = history.commits[suspects.now].hash;
        suspects.commits = repository->between(old, now).size();
        if (suspects.commits > 1) suspects.middle = repository->middle(old, now);
    }
    return all;
}

} // namespace shadowbench::history
