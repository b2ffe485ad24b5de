// Curves over the still frames from an empty history (the dissertation's Figs. 3.9 and 4.5).
#include "report/charts.h"
#include "report/gnuplot.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr int width = 960, plotHeight = 400; // pixels
constexpr double top = 84, bottomMargin = 62;

struct Curve {
    std::vector<double> values; // by frame, from 1
    std::size_t style;          // the same in both panels
};

struct Panel {
    std::string title;
    bool share;
    std::vector<Curve> curves;
};

std::vector<Curve> curvesOf(const std::vector<Record>& records, const std::vector<std::size_t>& shownRecords,
                            metrics::MetricId list) {
    std::vector<Curve> curves;
    for (std::size_t style = 0; style < shownRecords.size(); ++style) {
        const Record& record = records[shownRecords[style]];
        if (const std::vector<double>& values = record.values.list(list); !values.empty()) curves.push_back({values, style});
    }
    return curves;
}

metrics::MetricId errorList(bool soft) {
    return soft ? metrics::MetricId("stability.by_frame.rmse") : metrics::MetricId("stability.by_frame.mismatch");
}

std::vector<std::size_t> recordsWithCurves(const std::vector<Record>& records, const std::string& scene, bool soft) {
    std::vector<std::size_t> result;
    for (const std::size_t i : ofScene(records, scene)) {
        const metrics::Values& values = records[i].values;
        if (!values.list(errorList(soft)).empty() || !values.list("stability.by_frame.changed").empty()) result.push_back(i);
    }
    return result;
}

/// Without the last frame, which is compared with itself.
std::vector<Curve> changeCurves(const std::vector<Record>& records, const std::vector<std::size_t>& shownRecords) {
    std::vector<Curve> curves = curvesOf(records, shownRecords, "stability.by_frame.changed");
    for (Curve& curve : curves) curve.values.pop_back();
    std::erase_if(curves, [](const Curve& curve) { return curve.values.empty(); });
    return curves;
}

std::string panelScript(const Panel& panel, std::size_t column, std::size_t columns, double height) {
    const double share = 1.0 / static_cast<double>(columns);
    const double start = static_cast<double>(column) * share;
    std::vector<double> all;
    for (const Curve& curve : panel.curves) all.insert(all.end(), curve.values.begin(), curve.values.end());
    const LogAxis axis(all);

    std::string script = plotArea(start + 0.085, start + share - 0.02, top, plotHeight - bottomMargin, height);
    script += fmt::format("set title {} font ',14' offset 0,-0.4\n", literal(panel.title));
    script += "set xlabel 'frame'\nset xrange [1:*]\n" + axis.script("y", panel.share ? 100 : 1, panel.share ? " %%" : "");
    std::string plots;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        script += fmt::format("$curve{}_{} << EOD\n", column, i);
        for (std::size_t frame = 0; frame < panel.curves[i].values.size(); ++frame)
            script += fmt::format("{} {}\n", frame + 1, axis.drawn(panel.curves[i].values[frame]));
        script += "EOD\n";
        plots += fmt::format("{}$curve{}_{} with lines {} notitle", i == 0 ? "plot " : ", ", column, i,
                             lineStyle(panel.curves[i].style));
    }
    return script + plots + "\nunset label\nunset arrow\n";
}

} // namespace

std::optional<std::string> convergenceChart(const std::vector<Record>& records, const std::string& scene) {
    const std::string metric = headlineMetric(records, scene);
    const bool soft = metric == "rmse";
    const std::vector<std::size_t> shownRecords = recordsWithCurves(records, scene, soft);
    std::vector<Panel> panels{
        {"error against the truth: " + meaning(metric), isShare(metric), curvesOf(records, shownRecords, errorList(soft))},
        {"pixels > 30/255 off the technique's own last frame", true, changeCurves(records, shownRecords)}};
    std::erase_if(panels, [](const Panel& panel) { return panel.curves.empty(); });
    if (panels.empty()) return {};

    std::vector<std::string> variants;
    variants.reserve(shownRecords.size());
    for (const std::size_t i : shownRecords) variants.push_back(records[i].variant);
    const Legend legend{variants, plotHeight};
    const int height = legend.bottom();
    std::string script =
        "set multiplot\n" + heading(scene + ": convergence from an empty history", height) + legend.script();
    for (std::size_t i = 0; i < panels.size(); ++i) script += panelScript(panels[i], i, panels.size(), height);
    return svgOf(script + "unset multiplot\n", width, height);
}

} // namespace shadowbench::report
