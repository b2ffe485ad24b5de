#include "report/gnuplot.h"

#include "base/error.h"
#include "base/files.h"
#include "base/process.h"
#include "base/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

std::string header(int width, int height) {
    return fmt::format(
        "set terminal svg size {},{} font 'Liberation Sans,Arial,Helvetica,sans-serif,14' background '#FFFFFF' "
        "noenhanced dashlength 1.2\n"
        "set output 'chart.svg'\n"
        "set border 3 lw 1 lc rgb '#333333'\n"
        "set tics nomirror textcolor rgb '#333333'\n"
        "set grid xtics ytics lc rgb '#E4E4E4' lw 1 lt 1\n",
        width, height);
}

void runGnuplot(const std::filesystem::path& folder, const std::string& script) {
    const auto program = findProgram("gnuplot");
    if (!program) throw Inconclusive("drawing charts: gnuplot is not installed; run `apt-get install gnuplot-nox`");
    std::string messages;
    const Command command{*program, {"--default-settings", script}, folder};
    const Finished end = runProcess(command, [&](std::string_view line) { messages.append(line).append(" "); });
    if (end.timedOut)
        throw Inconclusive("drawing charts: gnuplot ran for more than a minute and was stopped; reinstall gnuplot-nox");
    if (end.signal != 0 || end.exitCode != 0)
        throw Inconclusive(fmt::format("drawing charts: gnuplot ended with status {}, signal {} ({}); reinstall gnuplot-nox",
                                       end.exitCode, end.signal, messages));
}

constexpr int legendRow = 22;            // pixels
constexpr std::size_t longestText = 200; // bytes: no chart has room for more, and drawing a million letters takes minutes

/// The text, or its beginning and "…".
std::string shortened(const std::string& text) {
    if (text.size() <= longestText) return text;
    std::size_t end = longestText;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end; // a character stays whole
    return text.substr(0, end).append("…");
}

struct Tick {
    double value;
    bool labelled;
};

/// Ticks at 1 … 9 × 10ⁿ within [low, high]: labelled at 1, 2 and 5, on an axis of more than three decades at 1 only.
std::vector<Tick> ticks(double low, double high) {
    const bool wide = std::log10(high / low) > 3;
    std::vector<Tick> result;
    for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= std::ceil(std::log10(high)); ++decade) {
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, decade);
            const bool labelled = digit == 1 || (!wide && (digit == 2 || digit == 5));
            if (value >= low && value <= high) result.push_back({value, labelled});
        }
    }
    return result;
}

} // namespace

std::string svgOf(const std::string& script, int width, int height) {
    const TemporaryFolder folder;
    writeFile(folder.path() / "chart.gp", header(width, height) + script);
    runGnuplot(folder.path(), "chart.gp");
    return readFile(folder.path() / "chart.svg");
}

std::string literal(const std::string& text) {
    std::string result = "'";
    for (const char letter : shortened(text)) {
        if (letter == '\'') result += '\'';
        const bool control = static_cast<unsigned char>(letter) < 0x20;
        result += control ? ' ' : letter;
    }
    return result + "'";
}

std::string colour(std::size_t i) {
    static constexpr std::array palette{blue, vermilion, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
    return palette[i % palette.size()];
}

std::string lineStyle(std::size_t i) { return fmt::format("lw 2 dt {} lc rgb '{}'", 1 + i / 7, colour(i)); }

std::string heading(const std::string& title, int height) {
    return fmt::format("set label {} at screen 0.085, screen {} left font ',18'\n", literal(title), 1 - 24.0 / height);
}

std::string plotArea(double left, double right, double top, double bottom, double height) {
    return fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\nset bmargin at screen {}\n", left,
        right, 1 - top / height, 1 - bottom / height);
}

int Legend::bottom() const { return top + legendRow * static_cast<int>((names.size() + 1) / 2) + 14; }

std::string Legend::script() const {
    const double height = bottom();
    std::string script;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double x = i % 2 == 0 ? 0.085 : 0.585;
        const std::size_t row = i / 2;
        const double y = 1 - (top + legendRow * (0.7 + static_cast<double>(row))) / height;
        script += fmt::format("set arrow from screen {0}, screen {1} to screen {2}, screen {1} nohead {3}\n", x, y,
                              x + 0.035, lineStyle(i));
        script += fmt::format("set label {} at screen {}, screen {} left font ',13'\n", literal(names[i]), x + 0.045, y);
    }
    return script;
}

LogAxis::LogAxis(const std::vector<double>& values) {
    double smallest = 1, largest = 1;
    bool any = false;
    for (const double value : values) {
        if (value <= 0) {
            hasZero_ = true;
            continue;
        }
        smallest = any ? std::min(smallest, value) : value;
        largest = any ? std::max(largest, value) : value;
        any = true;
    }
    const double room = std::pow(std::max(largest / smallest, 2.0), 0.12); // an eighth of the axis on each side
    high_ = largest * room;
    floor_ = smallest / (room * room);
    low_ = hasZero_ ? floor_ / std::sqrt(room) : smallest / room;
}

double LogAxis::drawn(double value) const { return value > 0 ? value : floor_; }

double LogAxis::position(double value) const { return std::log(drawn(value) / low_) / std::log(high_ / low_); }

std::string LogAxis::script(const std::string& axis, double factor, const std::string& unit) const {
    std::string labels;
    if (hasZero_) labels += fmt::format("'0{}' {}, ", unit, floor_);
    for (const Tick& tick : ticks((hasZero_ ? floor_ * 1.3 : low_) * factor, high_ * factor)) {
        const bool nearZero = hasZero_ && position(tick.value / factor) - position(0) < 0.05; // its label would lie on "0"
        if (tick.labelled && !nearZero)
            labels += fmt::format("'{:g}{}' {}, ", tick.value, unit, tick.value / factor);
        else
            labels += fmt::format("'' {} 1, ", tick.value / factor); // a minor tick
    }
    if (!labels.empty()) labels.resize(labels.size() - 2);
    return fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics ({3})\n", axis, low_, high_, labels);
}

} // namespace shadowbench::report
