// Frame times stacked by pass.
#include "report/cost_report.h"
#include "report/gnuplot.h"
#include "report/summary.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace shadowbench::report {
namespace {

constexpr int width = 960, rowHeight = 18; // pixels
constexpr double left = 0.3, right = 0.93, top = 60, bottomMargin = 56;
constexpr std::size_t mostColours = 7; // of the palette; other passes are grey

/// A record's bar: milliseconds by pass, in the frame's order.
struct Bar {
    std::string name;
    std::vector<std::pair<std::string, double>> parts;

    [[nodiscard]] double length() const {
        double sum = 0;
        for (const auto& [pass, milliseconds] : parts) sum += milliseconds;
        return sum;
    }
};

std::vector<Bar> barsOf(const std::vector<Record>& records, const std::string& scene) {
    std::vector<Bar> bars;
    for (const std::size_t i : ofScene(records, scene)) {
        const std::vector<TimedFrame> frames = timedFrames(records[i]);
        if (records[i].sweep || frames.empty()) continue;
        Bar bar{records[i].variant, {}};
        for (const PassRecord& pass : *frames.front().passes)
            if (pass.milliseconds) bar.parts.emplace_back(pass.name, *pass.milliseconds);
        if (bar.length() > 0) bars.push_back(std::move(bar));
    }
    return bars;
}

/// The passes that have colours of their own: those that most bars have, as the same names mean the same work.
std::vector<std::string> commonPasses(const std::vector<Bar>& bars) {
    std::vector<std::pair<std::string, int>> counts;
    for (const Bar& bar : bars)
        for (const auto& [pass, milliseconds] : bar.parts) {
            const auto known = std::ranges::find(counts, pass, &std::pair<std::string, int>::first);
            (known == counts.end() ? counts.emplace_back(pass, 0) : *known).second += 1;
        }
    std::ranges::stable_sort(counts, std::ranges::greater(), &std::pair<std::string, int>::second);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(counts.size(), mostColours); ++i) names.push_back(counts[i].first);
    return names;
}

/// Bars beyond this are cut: a few techniques cost many times what most do, which would leave no length to these.
double longestShown(const std::vector<Bar>& bars) {
    std::vector<double> lengths;
    for (const Bar& bar : bars) lengths.push_back(bar.length());
    std::ranges::sort(lengths);
    return std::min(lengths.back(), 4 * lengths[lengths.size() / 2]);
}

std::string colourOf(const std::vector<std::string>& names, const std::string& pass) {
    const auto found = std::ranges::find(names, pass);
    return found == names.end() ? "#C8C8C8" : colour(static_cast<std::size_t>(found - names.begin()));
}

/// Rectangles from left to right; beside them what the whole frame takes.
std::string barScript(const Bar& bar, std::size_t row, double longest, const std::vector<std::string>& names) {
    std::string script;
    double from = 0;
    const double y = static_cast<double>(row);
    for (const auto& [pass, milliseconds] : bar.parts) {
        const double to = std::min(from + milliseconds, longest);
        if (to > from)
            script += fmt::format("set object rectangle from {},{} to {},{} fs solid 1 noborder fc rgb '{}'\n", from,
                                  y - 0.36, to, y + 0.36, colourOf(names, pass));
        from = to;
    }
    const bool cut = bar.length() > longest;
    script += fmt::format("set label {} at {},{} left offset 0.5,0 font ',11'\n",
                          literal(fmt::format("{}{:.3g}", cut ? "› " : "", bar.length())), from, y);
    return script;
}

/// Colours and names below the plot, four a row.
std::string legendScript(const std::vector<std::string>& names, double plotBottom, double height) {
    std::string script;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double x = 0.04 + 0.24 * static_cast<double>(i % 4);
        const double y = 1 - (plotBottom + 14 + 20 * static_cast<double>(i / 4)) / height;
        script += fmt::format("set object rectangle from screen {},{} to screen {},{} fs solid 1 noborder fc rgb '{}'\n", x,
                              y - 5 / height, x + 0.018, y + 5 / height, colourOf(names, names[i]));
        script += fmt::format("set label {} at screen {}, screen {} left font ',12'\n", literal(names[i]), x + 0.025, y);
    }
    return script;
}

} // namespace

std::optional<std::string> passChart(const std::vector<Record>& records, const std::string& scene) {
    const std::vector<Bar> bars = barsOf(records, scene);
    if (bars.empty()) return {};
    std::vector<std::string> names = commonPasses(bars);
    const double longest = longestShown(bars);
    const double plotBottom = top + rowHeight * static_cast<double>(bars.size()) + bottomMargin;
    const int height = static_cast<int>(plotBottom) + 60;

    std::string script = heading(scene + ": frame time by pass", height);
    script += plotArea(left, right, top, plotBottom - bottomMargin, height);
    script += fmt::format("set xrange [0:{}]\nset yrange [{}:-0.6]\nset xlabel 'ms a frame'\nunset key\n", longest,
                          static_cast<double>(bars.size()) - 0.4);
    std::string tics;
    for (std::size_t row = 0; row < bars.size(); ++row) {
        script += barScript(bars[row], row, longest, names);
        tics += fmt::format("{}{} {}", row == 0 ? "" : ", ", literal(bars[row].name), row);
    }
    script += fmt::format("set ytics ({}) font ',11'\nset grid noytics\n", tics);
    names.emplace_back("other passes");
    script += legendScript(names, plotBottom, height);
    return svgOf(script + "plot NaN notitle\n", width, height);
}

} // namespace shadowbench::report
