// How much instruction counts of one program differ from run to run, and how often the gate's instruction tier errs: every
// run judged against every earlier one.
//
//   instruction_spread FOLDER… [--out FILE]
//
// Each folder holds the results.jsonl of a `run --cost instructions` of the same program. Without --out prints Markdown.
#include "base/error.h"
#include "base/files.h"
#include "harness/records/compare.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace shadowbench::benchmarks {
namespace {

struct Spread {
    std::vector<double> counts; // one a run

    /// Largest distance from the first run, as a share of it.
    [[nodiscard]] double relative() const {
        double largest = 0;
        for (const double count : counts) largest = std::max(largest, std::abs(count / counts.front() - 1));
        return largest;
    }
};

struct Alarms {
    int evaluations = 0, alarms = 0;
};

Alarms alarmsBetween(const std::vector<std::vector<Record>>& runs) {
    Alarms total;
    for (std::size_t head = 1; head < runs.size(); ++head)
        for (std::size_t base = 0; base < head; ++base)
            for (const gate::Change& change : gate::compare(runs[base], runs[head]).changes) {
                if (change.changeClass != gate::Class::Instructions) continue;
                ++total.evaluations;
                if (change.direction != gate::Direction::Same) ++total.alarms;
            }
    return total;
}

std::string report(const std::vector<std::vector<Record>>& runs) {
    std::map<std::pair<std::string, std::string>, Spread> cells;
    std::set<std::string> techniques, commits;
    for (const std::vector<Record>& run : runs)
        for (const Record& record : run) {
            if (!record.values["cost.instructions"]) continue;
            cells[{record.variant, record.scene}].counts.push_back(*record.values["cost.instructions"]);
            techniques.insert(record.technique);
            commits.insert(record.commit.substr(0, 12));
        }
    const Alarms alarms = alarmsBetween(runs);
    std::string text = fmt::format(
        "# Instruction counts of one program, {} runs\n\n{} cells of {} techniques, commit {}. Every run judged "
        "against every earlier one: {} alarms in {} evaluations of a cell.\n\n| technique | scene | instructions "
        "a frame | runs | largest difference from the first run |\n|---|---|--:|--:|--:|\n",
        runs.size(), cells.size(), techniques.size(), *commits.begin(), alarms.alarms, alarms.evaluations);
    for (const auto& [cell, spread] : cells)
        text += fmt::format("| {} | {} | {:.0f} | {} | {:.1e} |\n", cell.first, cell.second, spread.counts.front(),
                            spread.counts.size(), spread.relative());
    return text;
}

int main(int argc, char** argv) {
    CLI::App app("Instruction counts from run to run.", "instruction_spread");
    std::vector<std::filesystem::path> folders;
    std::filesystem::path out;
    app.add_option("folders", folders, "Folders of runs")->required()->expected(2, -1);
    app.add_option("--out", out, "Write the report there");
    CLI11_PARSE(app, argc, argv);
    std::vector<std::vector<Record>> runs;
    for (const std::filesystem::path& folder : folders) runs.push_back(readRecords(folder / "results.jsonl"));
    if (out.empty())
        fmt::print("{}", report(runs));
    else
        writeFile(out, report(runs));
    return 0;
}

} // namespace
} // namespace shadowbench::benchmarks

int main(int argc, char** argv) {
    try {
        return shadowbench::benchmarks::main(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "instruction_spread: {}\n", error.what());
        return 2;
    }
}
