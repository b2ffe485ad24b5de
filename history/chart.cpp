// A metric of a scene over commits.
#include "history/history_report.h"
#include "report/gnuplot.h"
#include "report/summary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::history {
namespace {

using report::literal;

constexpr int width = 960, plotHeight = 440; // pixels
constexpr double top = 60, bottomMargin = 84;
constexpr std::size_t mostLabels = 30, mostNamed = 14;

/// The series of one cell, one for each of its conditions; drawn in one colour.
struct Curve {
    std::string variant, cell;
    std::vector<std::size_t> series; // indices in the history's
    bool changes = false;
};

/// Those of the metric on the scene, the changed ones first, by the size of their largest change.
std::vector<Curve> curvesOf(const Findings& f, const std::string& metric, const std::string& scene) {
    std::vector<Curve> curves;
    const auto add = [&](std::size_t i, bool changes) {
        const Series& series = f.history.series[i];
        if (series.metric != metric || series.scene != scene) return;
        auto curve = std::ranges::find_if(
            curves, [&](const Curve& c) { return c.variant == series.variant && c.cell == series.cell; });
        if (curve == curves.end()) curve = curves.insert(curves.end(), {series.variant, series.cell, {}, changes});
        if (std::ranges::find(curve->series, i) == curve->series.end()) curve->series.push_back(i);
    };
    for (const LevelChange& change : f.changes) add(change.series, true);
    for (std::size_t i = 0; i < f.history.series.size(); ++i) add(i, false);
    return curves;
}

/// Logarithmic, but linear where figures are negative and where the logarithm would have no room for ticks.
class FiguresAxis {
public:
    FiguresAxis(const std::vector<double>& values, const Unit& unit) : logarithmic_(values), unit_(unit) {
        const auto [low, high] = std::ranges::minmax(values);
        const double room = high > low ? 0.15 * (high - low) : 0.1 * std::abs(high);
        low_ = low - room;
        high_ = high + room;
        linear_ = low < 0 || high < narrow * low;
    }

    [[nodiscard]] double drawn(double value) const { return linear_ ? unit_.factor * value : logarithmic_.drawn(value); }

    [[nodiscard]] std::string script() const {
        const std::string unit = unit_.name == " %" ? " %%" : unit_.name; // tick labels are formats
        if (!linear_) return logarithmic_.script("y", unit_.factor, unit);
        return fmt::format("set yrange [{}:{}]\nset format y '%g{}'\n", unit_.factor * low_, unit_.factor * high_, unit);
    }

private:
    static constexpr double narrow = 10; // largest figure by smallest

    report::LogAxis logarithmic_;
    Unit unit_;
    double low_, high_;
    bool linear_;
};

std::string commitsAxis(const std::vector<Commit>& commits) {
    const std::size_t step = (commits.size() + mostLabels - 1) / mostLabels;
    std::string labels;
    for (std::size_t i = 0; i < commits.size(); i += step)
        labels += fmt::format("{}{} {}", labels.empty() ? "" : ", ", literal(shortHash(commits[i].hash)), i);
    return fmt::format("set xrange [-0.5:{}]\nset xtics ({}) rotate by 45 right\n",
                       static_cast<double>(commits.size()) - 0.5, labels);
}

std::string nameOf(const Curve& curve, const std::vector<Curve>& all) {
    return std::ranges::count(all, curve.variant, &Curve::variant) == 1 ? curve.variant
                                                                        : fmt::format("{} ({})", curve.variant, curve.cell);
}

/// A figure a line, its levels and the starts of new ones.
std::string dataOf(const Findings& f, std::size_t i, const FiguresAxis& axis) {
    std::string text = fmt::format("$figures{} << EOD\n", i);
    for (const Point& point : f.history.series[i].points)
        text += fmt::format("{} {}\n", point.commit, axis.drawn(point.value));
    text += fmt::format("EOD\n$levels{} << EOD\n", i);
    for (const Level& level : f.levels[i])
        text += fmt::format("{0} {2}\n{1} {2}\n\n", level.first, level.last, axis.drawn(level.value));
    text += fmt::format("EOD\n$starts{} << EOD\n", i);
    for (std::size_t k = 1; k < f.levels[i].size(); ++k)
        text += fmt::format("{} {}\n", f.levels[i][k].first, axis.drawn(f.levels[i][k].value));
    return text + "EOD\n";
}

/// A line through the figures, or, of noisy ones, points with their levels as lines; circles where a new level begins.
std::string plotOf(const Findings& f, std::size_t i, const std::string& style) {
    const bool noisy = f.history.series[i].noisy;
    std::string plot =
        fmt::format("$figures{} with {} pt 7 ps 0.35 {} notitle, ", i, noisy ? "points" : "linespoints", style);
    if (noisy) plot += fmt::format("$levels{} with lines {} notitle, ", i, style);
    if (f.levels[i].size() > 1) plot += fmt::format("$starts{} with points pt 6 ps 1 {} notitle, ", i, style);
    return plot;
}

} // namespace

std::string chartName(const std::string& metric, const std::string& scene) { return metric + "-" + scene + ".svg"; }

std::string chart(const Findings& findings, const std::string& metric, const std::string& scene) {
    const std::vector<Curve> curves = curvesOf(findings, metric, scene);
    std::vector<double> values;
    std::vector<std::string> names;
    for (const Curve& curve : curves) {
        if (curve.changes && names.size() < mostNamed) names.push_back(nameOf(curve, curves));
        for (const std::size_t i : curve.series)
            for (const Point& point : findings.history.series[i].points) values.push_back(point.value);
    }
    const FiguresAxis axis(values, unitOf(metric));
    const report::Legend legend{names, plotHeight};
    const double height = legend.bottom();
    std::string script = report::heading(fmt::format("{}: {} over commits", scene, metric), legend.bottom()) +
                         legend.script() + commitsAxis(findings.history.commits) + axis.script();
    script += report::plotArea(0.085, 0.98, top, plotHeight - bottomMargin, height);
    std::string plots;
    for (std::size_t k = curves.size(); k > 0; --k) { // the named ones over the others
        const std::string style =
            k <= names.size() ? report::lineStyle(k - 1) : fmt::format("lw 1 lc rgb '{}'", report::grey);
        for (const std::size_t i : curves[k - 1].series) {
            script += dataOf(findings, i, axis);
            plots += plotOf(findings, i, style);
        }
    }
    plots.resize(plots.size() - 2); // the last comma
    return report::svgOf(script + "plot " + plots + "\n", width, legend.bottom());
}

} // namespace shadowbench::history
