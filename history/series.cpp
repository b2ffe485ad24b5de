#include "history/series.h"

#include "gate/paired.h"
#include "harness/records/metric_code.h"

#include <algorithm>
#include <fmt/format.h>
#include <fnmatch.h>
#include <map>
#include <optional>
#include <ranges>
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
    const metrics::Metric* line; // nothing for whether the cell is in error
};

/// All figures of a record that have a series.
std::vector<Figure> figuresOf(const Record& record) {
    using gate::Class;
    const bool scored = wasScored(record.status), error = record.status == Status::Error;
    std::vector<Figure> figures;
    if (scored || error) figures.push_back({errorMetric, Class::Status, false, error ? 1.0 : 0.0, 0, nullptr});
    if (!scored) return figures;
    for (const metrics::Metric& metric : metrics::table) {
        const bool noisy = metric.noisy && metric.about;
        const std::optional<double> value = noisy ? record.values[metric] : gate::comparedValue(metric, record);
        if (!value) continue;
        const double allowance = noisy ? gate::TimeRule{}.floor * *value : gate::allowanceOf(metric, record, *value);
        figures.push_back({metric.path, *metric.about, noisy, *value, allowance, &metric});
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

/// What each version of the code of metrics says of the one before.
gate::MetricCode codeOf(const std::vector<Commit>& commits) {
    gate::MetricCode code;
    std::map<gate::CellKey, const Record*> last;
    for (const Commit& commit : commits)
        for (const Record& record : commit.records) {
            if (!wasScored(record.status)) continue;
            const Record*& before = last[gate::cellOf(record)];
            if (before != nullptr) code.take(*before, record);
            before = &record;
        }
    return code;
}

/// Collects series: a figure goes to the newest one of its cell and metric whose last record its own can be compared with.
class Collector {
public:
    Collector(History& history, const std::vector<Commit>& commits) : history_(history), code_(codeOf(commits)) {}

    void take(const Record& record, std::size_t commit, const Figure& figure) {
        Series& series = of(record, figure);
        const bool again = !series.points.empty() && series.points.back().commit == commit;
        if (again && !figure.noisy) series.points.pop_back();
        series.points.push_back({commit, figure.value, figure.allowance});
    }

private:
    using Key = std::tuple<gate::CellKey, std::string_view>;
    struct Open {
        std::size_t series;
        const Record* last;
    };

    Series& of(const Record& record, const Figure& figure) {
        std::vector<Open>& open = open_[Key{gate::cellOf(record), figure.metric}];
        std::string apart;
        for (Open& one : std::views::reverse(open)) {
            const std::optional<std::string> why = whyApart(figure, *one.last, record);
            if (!why) {
                one.last = &record;
                return history_.series[one.series];
            }
            if (apart.empty()) apart = *why;
        }
        open.push_back({history_.series.size(), &record});
        return history_.series.emplace_back(Series{record.scene,
                                                   record.variant,
                                                   std::string(figure.metric),
                                                   cellText(record),
                                                   figure.metricClass,
                                                   figure.noisy,
                                                   apart,
                                                   {}});
    }

    [[nodiscard]] std::optional<std::string> whyApart(const Figure& figure, const Record& before, const Record& now) const {
        if (figure.line == nullptr) return {};
        if (auto why = gate::whyIncomparable(before, now)) return why;
        if (figure.noisy || figure.metricClass == gate::Class::Instructions)
            if (auto why = gate::difference(before.environment, now.environment, gate::EnvironmentScope::OfCounts))
                return "it was measured in other surroundings: " + *why;
        const bool same = before.values[*figure.line] == now.values[*figure.line];
        return code_.whyUnjudged(*figure.line, before, now, gate::sameImages(before, now), same);
    }

    History& history_;
    gate::MetricCode code_;
    std::map<Key, std::vector<Open>> open_;
};

} // namespace

History historyOf(const std::vector<Commit>& commits, const Selection& selection) {
    History history;
    Collector collector(history, commits);
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
                             [](const Series& s) { return std::tie(s.scene, s.metric, s.variant, s.cell); });
    return history;
}

} // namespace shadowbench::history
