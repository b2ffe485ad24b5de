// How often a slow drift, many small steps in one direction, is found over a history of commits, and how often one is said
// where there is none: by the change points of `shadowbench history`, and by an anchor, a commit from which the newest may
// differ by four times what one commit may.
//
//   drift [--out FILE]
//
// Histories are drawn with a fixed seed. Without --out prints Markdown.
#include "base/files.h"
#include "base/random.h"
#include "gate/paired.h"
#include "history/changes.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace shadowbench::benchmarks {
namespace {

using history::History;
using history::Series;

constexpr std::size_t histories = 40, commits = 40, seriesOfEach = 50, drifting = 5;
constexpr double noise = 0.015;  // of a time: the standard deviation from restart to restart in results/gate
constexpr double jitter = 0.001; // of an exact figure from commit to commit, either way
constexpr double allowanceOfInstructions = 0.005; // harness/metrics/table.h
constexpr double limit = 4;                       // of the anchor

struct Kind {
    const char* name;
    bool noisy;
    double allowance; // of one commit, a share
};

/// What one rule says of drifting and of steady series.
struct Tally {
    int found = 0, alarms = 0;

    void take(bool drifts, bool said) { (drifts ? found : alarms) += said ? 1 : 0; }
    [[nodiscard]] std::string row() const {
        return fmt::format("{:.0f} % | {:.2f} %", 100.0 * found / (histories * drifting),
                           100.0 * alarms / (histories * (seriesOfEach - drifting)));
    }
};

double normal(Random& random) { // Box and Muller
    return std::sqrt(-2 * std::log(1 - random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
}

/// Figures around 1 that rise to 1 + `drift` in equal steps.
Series draw(const Kind& kind, double drift, std::size_t number, Random& random) {
    Series series{"scene", fmt::format("{}", number), "cost", "", gate::Class::Instructions, kind.noisy, "", {}};
    for (std::size_t i = 0; i < commits; ++i) {
        const double level = 1 + drift * static_cast<double>(i) / (commits - 1);
        const double value = level * (kind.noisy ? std::exp(noise * normal(random)) : 1 + jitter * random.uniform(-1, 1));
        series.points.push_back({i, value, kind.allowance * value});
    }
    return series;
}

/// A row of the table: both rules on the same series.
std::string row(const Kind& kind, double drift) {
    Random random(34);
    Tally points, anchors;
    for (std::size_t h = 0; h < histories; ++h) {
        History history{std::vector<history::Commit>(commits), {}};
        for (std::size_t i = 0; i < seriesOfEach; ++i)
            history.series.push_back(draw(kind, i < drifting ? drift : 0, i, random));
        const history::Levels found = levelsOf(history, {});
        for (std::size_t i = 0; i < seriesOfEach; ++i) {
            const std::vector<history::Point>& figures = history.series[i].points;
            points.take(i<drifting, found.levels[i].size()> 1);
            anchors.take(i<drifting, figures.back().value> figures.front().value + limit * figures.front().allowance);
        }
    }
    return fmt::format("| {} | {:.0f} % | {} | {} |\n", kind.name, 100 * drift, points.row(), anchors.row());
}

std::string report() {
    std::string text = fmt::format(
        "# Slow drift\n\n{} histories a row, each of {} series over {} commits, {} of which rise to the total in equal "
        "steps. "
        "Times vary with a standard deviation of {} %; exact figures, such as instructions, by up to {} % from commit to "
        "commit. *Change points* are those of `shadowbench history`; the *anchor* is the first commit, from which the "
        "newest "
        "may differ by {} times what one commit may ({} % of a time, {} % of instructions). Made by "
        "`build/release/benchmarks/drift`.\n\n"
        "| figures | total | change points: found | said of steady ones | anchor: found | said of steady ones |\n"
        "|---|--:|--:|--:|--:|--:|\n",
        histories, seriesOfEach, commits, drifting, 100 * noise, 100 * jitter, limit, 100 * gate::TimeRule{}.floor,
        100 * allowanceOfInstructions);
    for (const Kind& kind : {Kind{"times", true, gate::TimeRule{}.floor}, Kind{"exact", false, allowanceOfInstructions}})
        for (const double drift : {0.0, 0.01, 0.02, 0.04, 0.08}) text += row(kind, drift);
    return text;
}

int main(int argc, char** argv) {
    CLI::App app("How often a slow drift is found.", "drift");
    std::filesystem::path out;
    app.add_option("--out", out, "Write the report there");
    CLI11_PARSE(app, argc, argv);
    if (out.empty())
        fmt::print("{}", report());
    else
        writeFile(out, report());
    return 0;
}

} // namespace
} // namespace shadowbench::benchmarks

int main(int argc, char** argv) {
    try {
        return shadowbench::benchmarks::main(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "drift: {}\n", error.what());
        return 2;
    }
}
