#include "report/gnuplot.h"
#include "report/truth_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace shadowbench::report {
namespace {

using groundtruth::Reference;
using groundtruth::Surface;

constexpr int width = 960, height = 400; // pixels
constexpr double binWidth = 0.25;        // pixels of edge distance
constexpr int sigmaBins = 32;

/// Shares of pixels in bins of one width from 0 on.
struct Histogram {
    std::string title, axis, colour;
    double width = 1;
    std::vector<double> shares;
};

/// Of the receiver pixels, how many lie how far from an edge; those farther than oracles look are left out.
Histogram edgeDistances(const Reference& reference) {
    Histogram histogram{"distance to the nearest hard shadow edge", "pixels", blue, binWidth, {}};
    histogram.shares.resize(static_cast<std::size_t>(farthestEdge / binWidth));
    std::size_t receivers = 0;
    for (std::size_t i = 0; i < reference.surface.size(); ++i) {
        if (reference.surface[i] != Surface::Receiver) continue;
        ++receivers;
        const double bin = reference.edgeDistance[i] / binWidth;
        if (bin < static_cast<double>(histogram.shares.size())) ++histogram.shares[static_cast<std::size_t>(bin)];
    }
    for (double& share : histogram.shares) share /= static_cast<double>(std::max<std::size_t>(receivers, 1));
    return histogram;
}

/// Of the receiver pixels, how many have which σ; those where it is 0 are left out.
Histogram sigmas(const ShownReference& shown) {
    const Reference& reference = shown.reference;
    const TruthNumbers numbers = truthNumbers(reference);
    Histogram histogram{fmt::format("σ* of the {} truth, where it is not 0", shown.truth),
                        "σ*",
                        vermilion,
                        numbers.sigmaLargest / sigmaBins,
                        {}};
    histogram.shares.resize(sigmaBins);
    for (std::size_t i = 0; i < reference.surface.size(); ++i) {
        if (reference.surface[i] != Surface::Receiver || reference.sigma[i] <= 0) continue;
        const auto bin = static_cast<std::size_t>(reference.sigma[i] / histogram.width);
        histogram.shares[std::min<std::size_t>(bin, sigmaBins - 1)] += 1 / static_cast<double>(numbers.receivers);
    }
    return histogram;
}

/// The smallest of 1, 2, 5 × 10ⁿ that cuts `range` into at most five steps.
double tickStep(double range) {
    const double least = range / 5, decade = std::pow(10, std::floor(std::log10(least)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * decade >= least) return digit * decade;
    return 10 * decade;
}

std::string panel(const Histogram& histogram, std::size_t column, std::size_t columns) {
    const double left = static_cast<double>(column) / static_cast<double>(columns), size = 1 / static_cast<double>(columns);
    const auto bins = static_cast<double>(histogram.shares.size());
    std::string script = fmt::format("set origin {},0\nset size {},1\nset title {} font ',14'\nset xlabel {}\n", left, size,
                                     literal(histogram.title), literal(histogram.axis));
    const double range = bins * histogram.width;
    script += fmt::format("set xrange [0:{}]\nset xtics {}\n$bins{} << EOD\n", range, tickStep(range), column);
    for (std::size_t i = 0; i < histogram.shares.size(); ++i)
        script += fmt::format("{} {}\n", (static_cast<double>(i) + 0.5) * histogram.width, 100 * histogram.shares[i]);
    return script + fmt::format("EOD\nset boxwidth {}\nplot $bins{} with boxes lc rgb '{}' notitle\n", 0.9 * histogram.width,
                                column, histogram.colour);
}

/// Seconds by series, the series in the order of their first occurrence; x is the scene's number.
struct Series {
    std::string name;
    std::vector<std::pair<std::size_t, double>> points;
};

std::vector<Series> seconds(const std::vector<TruthOfScene>& scenes) {
    std::vector<Series> all;
    const auto add = [&](const std::string& name, std::size_t scene, double value) {
        auto found = std::ranges::find(all, name, &Series::name);
        if (found == all.end()) found = all.insert(all.end(), {name, {}});
        found->points.emplace_back(scene, value);
    };
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        for (const groundtruth::Agreement& agreement : scenes[i].agreements) {
            add(fmt::format("{}, {}", agreement.a, agreement.pixelsCompared), i, agreement.secondsA);
            add(fmt::format("{}, {}", agreement.b, agreement.pixelsCompared), i, agreement.secondsB);
        }
        for (const ShownReference& shown : scenes[i].references)
            add(shown.truth + " reference, whole", i, shown.reference.provenance.seconds);
    }
    return all;
}

} // namespace

std::string histograms(const TruthOfScene& scene) {
    std::vector<Histogram> panels;
    for (const ShownReference& shown : scene.references) {
        if (shown.truth == "hard") panels.push_back(edgeDistances(shown.reference));
        if (truthNumbers(shown.reference).sigmaLargest > 0) panels.push_back(sigmas(shown));
    }
    std::string script = "set multiplot\nset style fill solid 0.85 noborder\nset ylabel '% of the receiver pixels'\n"
                         "set yrange [0:*]\n";
    for (std::size_t i = 0; i < panels.size(); ++i) script += panel(panels[i], i, panels.size());
    return svgOf(script + "unset multiplot\n", width, height);
}

std::string secondsChart(const std::vector<TruthOfScene>& scenes) {
    const std::vector<Series> all = seconds(scenes);
    std::vector<double> values;
    for (const Series& series : all)
        for (const auto& [scene, value] : series.points) values.push_back(value);
    std::string script =
        "set ylabel 'seconds'\nset key outside top center horizontal\n" + LogAxis(values).script("y", 1, " s");
    std::string tics;
    for (std::size_t i = 0; i < scenes.size(); ++i)
        tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", literal(scenes[i].scene), i);
    script += fmt::format("set xrange [-0.5:{}]\nset xtics ({})\n", static_cast<double>(scenes.size()) - 0.5, tics);
    std::string plots;
    for (std::size_t s = 0; s < all.size(); ++s) {
        script += fmt::format("$series{} << EOD\n", s);
        for (const auto& [scene, value] : all[s].points) script += fmt::format("{} {}\n", scene, value);
        script += "EOD\n";
        plots += fmt::format("{}$series{} with points pt 7 ps 1.2 lc rgb '{}' title {}", s == 0 ? "plot " : ", ", s,
                             colour(s), literal(all[s].name));
    }
    return svgOf(script + plots + "\n", width, height);
}

} // namespace shadowbench::report
