#include "harness/report/gnuplot.h"

#include "harness/scene/error.h"
#include "harness/scene/files.h"

#include <algorithm>
#include <array>
#include <boost/process.hpp>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace shadowbench::report {
namespace {

namespace process = boost::process;

/// A folder of our own that goes when we are done.
class PrivateFolder {
public:
    PrivateFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "shadowbench-chart-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw InternalError(fmt::format("drawing a chart: no folder can be made in {}; free some space or set TMPDIR",
                                            std::filesystem::temp_directory_path().string()));
        path_ = pattern;
    }
    ~PrivateFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

std::string header(const std::filesystem::path& output, int width, int height) {
    return fmt::format(
        "set terminal svg size {},{} font 'Liberation Sans,Arial,Helvetica,sans-serif,14' background '#FFFFFF' "
        "noenhanced dashlength 1.2\n"
        "set output {}\n"
        "set border 3 lw 1 lc rgb '#333333'\n"
        "set tics nomirror textcolor rgb '#333333'\n"
        "set grid xtics ytics lc rgb '#E4E4E4' lw 1 lt 1\n",
        width, height, literal(output.string()));
}

void runGnuplot(const std::filesystem::path& script, const std::filesystem::path& messages) {
    const auto program = process::search_path("gnuplot");
    if (program.empty()) throw Inconclusive("drawing charts: gnuplot is not installed; run `apt-get install gnuplot-nox`");
    std::error_code failure;
    const int status = process::system(program, "--default-settings", script.string(),
                                       process::std_in<process::null, process::std_out> process::null,
                                       process::std_err > messages.string(), failure);
    if (failure)
        throw Inconclusive(
            fmt::format("drawing charts: gnuplot cannot be run ({}); run `apt-get install gnuplot-nox`", failure.message()));
    if (status == 0) return;
    const std::string text = readFile(messages);
    throw Inconclusive(fmt::format("drawing charts: gnuplot failed with status {} ({}); reinstall gnuplot-nox", status,
                                   text.substr(0, text.find_last_not_of('\n') + 1)));
}

/// Ticks 1, 2, 5 × 10ⁿ within [low, high]; powers of ten only on an axis of more than two decades.
std::vector<double> ticks(double low, double high) {
    const bool wide = std::log10(high / low) > 2;
    std::vector<double> result;
    for (int decade = static_cast<int>(std::floor(std::log10(low))); decade <= std::ceil(std::log10(high)); ++decade) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, decade);
            if (value >= low && value <= high && (!wide || digit == 1.0)) result.push_back(value);
        }
    }
    return result;
}

} // namespace

std::string svgOf(const std::string& script, int width, int height) {
    const PrivateFolder folder;
    writeFile(folder.file("chart.gp"), header(folder.file("chart.svg"), width, height) + script);
    runGnuplot(folder.file("chart.gp"), folder.file("messages"));
    return readFile(folder.file("chart.svg"));
}

std::string literal(const std::string& text) {
    std::string result = "'";
    for (const char letter : text) {
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
    for (const double tick : ticks((hasZero_ ? floor_ * 1.3 : low_) * factor, high_ * factor))
        labels += fmt::format("'{:g}{}' {}, ", tick, unit, tick / factor);
    if (!labels.empty()) labels.resize(labels.size() - 2);
    return fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics ({3})\n", axis, low_, high_, labels);
}

} // namespace shadowbench::report
