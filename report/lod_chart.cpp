// Curves along the walk: popping and frame time of level-of-detail techniques.
#include "report/gnuplot.h"
#include "report/lod_report.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr int width = 960, plotHeight = 400; // pixels
constexpr double top = 84, bottomMargin = 62;

struct Panel {
    std::string title;
    metrics::MetricId curve;
    int firstFrame; // of the curve
    double factor;
};

std::string script(const Panel& panel, int column, const std::vector<const Record*>& records, double height) {
    const double start = 0.5 * column;
    std::string text = plotArea(start + 0.085, start + 0.48, top, plotHeight - bottomMargin, height);
    text += fmt::format("set title {} font ',14' offset 0,-0.4\nset xlabel 'frame'\n", literal(panel.title));
    std::string plots;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const std::vector<double>& values = records[i]->values.list(panel.curve);
        if (values.empty()) continue;
        text += fmt::format("$curve{}_{} << EOD\n", column, i);
        for (std::size_t frame = 0; frame < values.size(); ++frame)
            text += fmt::format("{} {}\n", static_cast<int>(frame) + panel.firstFrame, panel.factor * values[frame]);
        text += "EOD\n";
        plots += fmt::format("{}$curve{}_{} with lines {} notitle", plots.empty() ? "plot " : ", ", column, i, lineStyle(i));
    }
    if (plots.empty()) return "";
    return text + plots + "\nunset label\nunset arrow\n";
}

} // namespace

std::optional<std::string> lodChart(const std::vector<Record>& records, const std::string& scene) {
    std::vector<const Record*> shown;
    std::vector<std::string> names;
    for (const std::size_t i : ofScene(records, scene)) {
        const Record& record = records[i];
        if (record.sweep || record.values.list("lod.by_frame.pop").empty()) continue;
        shown.push_back(&record);
        names.push_back(record.variant);
    }
    if (shown.empty()) return {};
    const Legend legend{names, plotHeight};
    const int height = legend.bottom();
    std::string text =
        "set multiplot\n" + heading(scene + ": along the walk past levels of detail", height) + legend.script();
    text += script({"pop: mean change of colour, camera standing, 1/1000", "lod.by_frame.pop", 1, 1000}, 0, shown, height);
    text += script({"frame time, ms", "lod.by_frame.milliseconds", 0, 1}, 1, shown, height);
    return svgOf(text + "unset multiplot\n", width, height);
}

} // namespace shadowbench::report
