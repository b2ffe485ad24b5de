// Errors over frames.
#include "report/charts.h"
#include "report/gnuplot.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

constexpr int width = 960, plotHeight = 460; // pixels
constexpr double top = 60, bottomMargin = 62;

} // namespace

std::optional<std::string> framesChart(const std::string& title, const std::string& error,
                                       const std::vector<FramesCurve>& curves) {
    std::vector<std::string> names;
    std::vector<double> all;
    std::size_t frames = 2;
    for (const FramesCurve& curve : curves) {
        names.push_back(curve.name);
        all.insert(all.end(), curve.values.begin(), curve.values.end());
        frames = std::max(frames, curve.values.size());
    }
    if (all.empty()) return {};
    const LogAxis axis(all);
    const Legend legend{names, plotHeight};
    const int height = legend.bottom();
    std::string script =
        heading(title, height) + legend.script() + plotArea(0.085, 0.98, top, plotHeight - bottomMargin, height);
    script += fmt::format("set xlabel 'frame'\nset logscale x\nset xrange [1:{}]\nset ylabel {}\n", frames, literal(error));
    script += axis.script("y", 1, "");
    std::string plots;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::vector<double>& values = curves[i].values;
        script += fmt::format("$curve{} << EOD\n", i);
        for (std::size_t frame = 0; frame < values.size(); ++frame)
            script += fmt::format("{} {}\n", frame + 1, axis.drawn(values[frame]));
        if (values.size() == 1) script += fmt::format("{} {}\n", frames, axis.drawn(values[0])); // a level
        script += "EOD\n";
        plots += fmt::format("{}$curve{} with lines {} notitle", i == 0 ? "plot " : ", ", i, lineStyle(i));
    }
    return svgOf(script + plots + "\n", width, height);
}

} // namespace shadowbench::report
