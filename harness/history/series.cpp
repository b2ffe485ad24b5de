#include "harness/history/series.h"

#include "harness/gate/paired.h"

#include <algorithm>
#include <fmt/format.h>
#include <fnmatch.h>
#include <map>
#include <tuple>

namespace shadowbench::history {
namespace {

constexpr std::string_view errorMetric = "status.error";

bool matches(const std::vector<std::string>& patterns, const std::string& text) {
    return std::ranges::any_of(patterns, [&](const std::string& p) { return fnmatch(p.c_str(), text.c_str(), 0) == 0; });
}

bool isSelected(const Selection& selection, const Record& record) {
    return (selection.scenes.empty() || matches(selection.scenes, record.scene)) &&
           (selection.techniques.empty() || matches(selection.techniques, record.technique) ||
            matches(selection.techniques, record.variant));
}

struct Figure {
    std::string_view metric;
    gate::Class metricClass;
    bool noisy;
    double value, allowance;
    std::string conditions;
};

std::string rasteriser(const Environment& e) {
    if (e.gl == notDrawnHere) return e.gl; // the next version of another renderer is what a series shows
    const bool osMesa = e.platform.empty() || e.platform == "osmesa"; // which older records do not say
    return fmt::format("{}, {}, {} raster threads, {} bits{}", e.renderer, e.gl, e.rasterThreads, e.vectorBits,
                       osMesa ? "" : ", through " + e.platform);
}

/// All figures of a record that have a series.
std::vector<Figure> figuresOf(const Record& record) {
    using gate::Class;
    const bool scored = wasScored(record.status), error = record.status == Status::Error;
    std::vector<Figure> figures;
    if (scored || error) figures.push_back({errorMetric, Class::Status, false, error ? 1.0 : 0.0, 0, ""});
    if (!scored) return figures;
    const auto scoredIn = [&](const metrics::Metric& metric) { // rasteriser and truth decide a score
        const std::optional<ReferenceInfo>& truth = gate::truthOf(metric, record);
        return fmt::format("{}; truth {}", rasteriser(record.environment), truth ? truth->key : "");
    };
    for (const metrics::Metric& metric : metrics::table) {
        const std::optional<double> value = gate::comparedValue(metric, record);
        if (!value) continue;
        const bool counted = metric.about == Class::Instructions;
        figures.push_back({metric.path, *metric.about, false, *value, gate::allowanceOf(metric, record, *value),
                           counted ? gate::countingEnvironment(record.environment) : scoredIn(metric)});
    }
    for (const metrics::Metric& metric : metrics::table) {
        const std::optional<double>& value = record.values[metric];
        if (!metric.noisy || !metric.about || !value) continue;
        figures.push_back({metric.path, *metric.about, true, *value, gate::TimeRule{}.floor * *value,
                           fmt::format("{}, {}", rasteriser(record.environment), record.environment.cpu)});
    }
    return figures;
}

/// The part of a cell's key that its scene and variant leave open.
std::string cellText(const Record& record) {
    std::string text = fmt::format("{} {}×{}", record.profile, record.width, record.height);
    if (record.seed != 1) text += fmt::format(" seed {}", record.seed);
    if (record.sweep) text += fmt::format(" {} {:g} {}", record.sweep->axis, record.sweep->value, record.sweep->unit);
    return text;
}

/// Collects series and numbers the conditions in the order in which they first occur.
class Collector {
public:
    explicit Collector(History& history) : history_(history) {}

    void take(const Record& record, std::size_t commit, const Figure& figure) {
        Series& series = of(record, figure);
        const bool again = !series.points.empty() && series.points.back().commit == commit;
        if (again && !figure.noisy) series.points.pop_back();
        series.points.push_back({commit, figure.value, figure.allowance});
    }

private:
    using Key = std::tuple<gate::CellKey, std::string_view, std::size_t>;

    Series& of(const Record& record, const Figure& figure) {
        const std::size_t conditions = numberOf(figure.conditions);
        const auto [found, isNew] =
            places_.try_emplace(Key{gate::cellOf(record), figure.metric, conditions}, history_.series.size());
        if (isNew)
            history_.series.push_back({record.scene,
                                       record.variant,
                                       std::string(figure.metric),
                                       cellText(record),
                                       figure.metricClass,
                                       figure.noisy,
                                       conditions,
                                       {}});
        return history_.series[found->second];
    }

    std::size_t numberOf(const std::string& conditions) {
        const auto found = std::ranges::find(history_.conditions, conditions);
        if (found != history_.conditions.end()) return static_cast<std::size_t>(found - history_.conditions.begin());
        history_.conditions.push_back(conditions);
        return history_.conditions.size() - 1;
    }

    History& history_;
    std::map<Key, std::size_t> places_;
};

} // namespace

History historyOf(const std::vector<Commit>& commits, const Selection& selection) {
    History history;
    Collector collector(history);
    for (const Commit& commit : commits) {
        const std::size_t index = history.commits.size();
        history.commits.push_back({commit.hash, commit.date, {}});
        for (const Record& record : commit.records) {
            if (!isSelected(selection, record)) continue;
            for (const Figure& figure : figuresOf(record))
                if (selection.metrics.empty() || matches(selection.metrics, std::string(figure.metric)))
                    collector.take(record, index, figure);
        }
    }
    std::ranges::stable_sort(history.series, {},
                             [](const Series& s) { return std::tie(s.scene, s.metric, s.variant, s.cell, s.conditions); });
    return history;
}

} // namespace shadowbench::history
