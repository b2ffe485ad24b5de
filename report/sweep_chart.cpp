#include "report/charts.h"
#include "report/gnuplot.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace shadowbench::report {
namespace {

constexpr int width = 960, plotHeight = 460; // pixels
constexpr double top = 60, bottomMargin = 62;

struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points; // value of the axis, error
};

std::vector<Curve> curvesOf(const std::vector<Record>& records, const std::string& metric) {
    std::vector<Curve> curves;
    for (const Record& record : records) {
        if (record.status != Status::Scored) continue;
        const std::optional<double> error = metrics::bounded(record.values, metric);
        if (!error) continue;
        auto curve = std::ranges::find(curves, record.sweep->curve, &Curve::name);
        if (curve == curves.end()) curve = curves.insert(curves.end(), {record.sweep->curve, {}});
        curve->points.emplace_back(record.sweep->value, *error);
    }
    return curves;
}

std::string horizontalAxis(const std::vector<Curve>& curves, const SweepStep& step, bool logarithmic) {
    std::vector<double> values;
    for (const Curve& curve : curves)
        for (const auto& [value, error] : curve.points) values.push_back(value);
    const std::string title = step.unit.empty() ? step.axis : fmt::format("{} [{}]", step.axis, step.unit);
    std::string script = fmt::format("set xlabel {}\n", literal(title));
    if (logarithmic) return script + LogAxis(values).script("x", 1, "");
    const auto [low, high] = std::ranges::minmax(values);
    return script + fmt::format("set xrange [{}:{}]\n", low, high > low ? high : low + 1);
}

std::string toleranceLine(const std::optional<Tolerance>& limit, const LogAxis& error) {
    if (!limit || limit->value < error.low() || limit->value > error.high()) return "";
    return fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead lw 1 dt 3 lc rgb '{1}'\n"
                       "set label {2} at graph 0.01, first {0} left offset 0,0.5 font ',12' textcolor rgb '{1}'\n",
                       limit->value, grey, literal("tolerance " + formatBound(*limit)));
}

} // namespace

std::optional<std::string> sweepChart(const std::vector<Record>& records, bool logarithmic) {
    if (records.empty()) return {};
    const std::string& scene = records.front().scene;
    const std::optional<Tolerance> limit = tolerance(records, scene);
    const std::string metric = limit ? limit->metric : headlineMetric(records, scene);
    const std::vector<Curve> curves = curvesOf(records, metric);
    if (curves.empty()) return {};

    std::vector<std::string> names;
    std::vector<double> errors;
    for (const Curve& curve : curves) {
        names.push_back(curve.name);
        for (const auto& [value, error] : curve.points) errors.push_back(error);
    }
    const LogAxis error(errors);
    const Legend legend{names, plotHeight};
    const double height = legend.bottom();
    const SweepStep& step = *records.front().sweep;
    std::string script = heading(fmt::format("{}: {} over {}", scene, meaning(metric), step.axis), legend.bottom()) +
                         legend.script() + horizontalAxis(curves, step, logarithmic) +
                         error.script("y", isShare(metric) ? 100 : 1, isShare(metric) ? " %%" : "") +
                         toleranceLine(limit, error);
    script += plotArea(0.085, 0.98, top, plotHeight - bottomMargin, height);
    std::string plots;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        script += fmt::format("$curve{} << EOD\n", i);
        for (const auto& [value, y] : curves[i].points) script += fmt::format("{} {}\n", value, error.drawn(y));
        script += "EOD\n";
        plots += fmt::format("{}$curve{} with linespoints pt 7 ps 0.4 {} notitle", i == 0 ? "plot " : ", ", i, lineStyle(i));
    }
    return svgOf(script + plots + "\n", width, legend.bottom());
}

} // namespace shadowbench::report
