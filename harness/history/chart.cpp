// A metric of a scene over commits.
#include "harness/history/report.h"
#include "harness/report/gnuplot.h"
#include "harness/report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::history {
namespace {

using report::grey;
using report::literal;

constexpr int width = 960, plotHeight = 440; // pixels
constexpr double top = 60, bottomMargin = 84;
constexpr std::size_t mostLabels = 30, mostNamed = 14;

struct Curve {
    const Series* series;
    const std::vector<Level>* levels;
};

/// Those of the metric on the scene, the changed ones first, by the size of their largest change.
std::vector<Curve> curvesOf(const Findings& f, const std::string& metric, const std::string& scene) {
    std::vector<std::size_t> order;
    const auto add = [&](std::size_t i) {
        const Series& series = f.history.series[i];
        if (series.metric == metric && series.scene == scene && std::ranges::find(order, i) == order.end())
            order.push_back(i);
    };
    for (const LevelChange& change : f.changes) add(change.series);
    for (std::size_t i = 0; i < f.history.series.size(); ++i) add(i);
    std::vector<Curve> curves;
    for (const std::size_t i : order) curves.push_back({&f.history.series[i], &f.levels[i]});
    return curves;
}

std::string commitsAxis(const std::vector<Commit>& commits) {
    const std::size_t step = (commits.size() + mostLabels - 1) / mostLabels;
    std::string labels;
    for (std::size_t i = 0; i < commits.size(); i += step)
        labels += fmt::format("{}{} {}", labels.empty() ? "" : ", ", literal(shortHash(commits[i].hash)), i);
    return fmt::format("set xrange [-0.5:{}]\nset xtics ({}) rotate by 45 right\n",
                       static_cast<double>(commits.size()) - 0.5, labels);
}

/// Named where the metric is known under several conditions or in several cells.
std::string nameOf(const Curve& curve, const std::vector<Curve>& all) {
    const auto same = [&](const Curve& other) { return other.series->variant == curve.series->variant; };
    if (std::ranges::count_if(all, same) == 1) return curve.series->variant;
    return fmt::format("{} ({}, conditions {})", curve.series->variant, curve.series->cell, curve.series->conditions + 1);
}

/// A figure a line; a noisy series is drawn as points with its levels as lines.
std::string dataOf(const Curve& curve, std::size_t i, const report::LogAxis& axis) {
    std::string text = fmt::format("$figures{} << EOD\n", i);
    for (const Point& point : curve.series->points) text += fmt::format("{} {}\n", point.commit, axis.drawn(point.value));
    text += fmt::format("EOD\n$levels{} << EOD\n", i);
    for (const Level& level : *curve.levels)
        text += fmt::format("{0} {2}\n{1} {2}\n\n", level.first, level.last, axis.drawn(level.value));
    text += fmt::format("EOD\n$starts{} << EOD\n", i);
    for (std::size_t k = 1; k < curve.levels->size(); ++k)
        text += fmt::format("{} {}\n", (*curve.levels)[k].first, axis.drawn((*curve.levels)[k].value));
    return text + "EOD\n";
}

} // namespace

std::string chartName(const std::string& metric, const std::string& scene) { return metric + "-" + scene + ".svg"; }

std::string chart(const Findings& findings, const std::string& metric, const std::string& scene) {
    const std::vector<Curve> curves = curvesOf(findings, metric, scene);
    std::vector<double> values;
    for (const Curve& curve : curves)
        for (const Point& point : curve.series->points) values.push_back(point.value);
    const report::LogAxis axis(values);

    std::vector<std::string> names;
    for (const Curve& curve : curves)
        if (curve.levels->size() > 1 && names.size() < mostNamed) names.push_back(nameOf(curve, curves));
    const report::Legend legend{names, plotHeight};
    const double height = legend.bottom();

    const std::string last = metric.substr(metric.rfind('.') + 1);
    const bool share = report::isShare(last) || last == "flip_rate", millions = last == "instructions";
    std::string script = report::heading(fmt::format("{}: {} over commits", scene, metric), legend.bottom()) +
                         legend.script() + commitsAxis(findings.history.commits) +
                         axis.script("y",
                                     share      ? 100
                                     : millions ? 1e-6
                                                : 1,
                                     share      ? " %%"
                                     : millions ? " M"
                                                : "");
    script += fmt::format(
        "set lmargin at screen 0.085\nset rmargin at screen 0.98\nset tmargin at screen {}\nset bmargin at screen {}\n",
        1 - top / height, 1 - (plotHeight - bottomMargin) / height);
    std::string plots;
    for (std::size_t k = curves.size(); k > 0; --k) { // the named ones over the others
        const std::size_t i = k - 1;
        const std::string style = i < names.size() ? report::lineStyle(i) : fmt::format("lw 1 lc rgb '{}'", grey);
        const bool noisy = curves[i].series->noisy;
        script += dataOf(curves[i], i, axis);
        plots += fmt::format("{0}$figures{1} with {2} pt 7 ps 0.35 {3} notitle", plots.empty() ? "plot " : ", ", i,
                             noisy ? "points" : "linespoints", style);
        if (noisy) plots += fmt::format(", $levels{} with lines {} notitle", i, style);
        if (curves[i].levels->size() > 1) plots += fmt::format(", $starts{} with points pt 6 ps 1 {} notitle", i, style);
    }
    return report::svgOf(script + plots + "\n", width, legend.bottom());
}

} // namespace shadowbench::history
