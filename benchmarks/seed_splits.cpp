// How often the gate's rule for techniques that chance decides errs: seeds of one program judged against other seeds of it,
// and against seeds whose errors are larger by a factor.
//
//   seed_splits FOLDER… [--out FILE]
//
// Each folder holds the results.jsonl of a run of the same program with another --seed. Without --out prints Markdown.
#include "base/error.h"
#include "base/files.h"
#include "base/random.h"
#include "harness/records/compare.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

namespace shadowbench::benchmarks {
namespace {

using gate::Change;
using gate::Direction;
using Runs = std::vector<std::vector<Record>>;

constexpr std::size_t seeds = 8; // a side, as the gate has

/// Some of the runs as those of seeds 1, 2 …, with errors that are `factor` times as large.
std::vector<Record> relabelled(const Runs& runs, const std::vector<std::size_t>& which, double factor = 1) {
    std::vector<Record> records;
    std::uint32_t seed = 0;
    for (const std::size_t run : which) {
        ++seed;
        for (Record record : runs[run]) {
            record.seed = seed;
            record.images = fmt::format("{} {}", run, factor);
            if (factor != 1)
                for (const metrics::Metric& metric : metrics::linesOf("accuracy"))
                    if (auto& value = record.values[metric]; value && metric.allowance)
                        value = metric.allowance->best + factor * (*value - metric.allowance->best);
            records.push_back(std::move(record));
        }
    }
    return records;
}

/// `count` of the numbers, drawn without replacement.
std::vector<std::size_t> drawn(std::vector<std::size_t> numbers, std::size_t count, Random& random) {
    for (std::size_t i = 0; i < count; ++i)
        std::swap(numbers[i],
                  numbers[i + static_cast<std::size_t>(random.uniform() * static_cast<double>(numbers.size() - i))]);
    numbers.resize(count);
    return numbers;
}

std::vector<std::size_t> range(std::size_t first, std::size_t last) {
    std::vector<std::size_t> numbers(last - first);
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
}

struct Errors {
    int comparisons = 0, red = 0;
    std::map<std::string, int> metrics; // of the false reds
};

/// `trials` comparisons; `halves` gives the seeds of base and head.
Errors errorsOf(const Runs& runs, int trials, const auto& halves) {
    Errors errors;
    for (; errors.comparisons < trials; ++errors.comparisons) {
        const auto [base, head] = halves();
        bool red = false;
        for (const Change& change : gate::compare(relabelled(runs, base), relabelled(runs, head)).changes) {
            if (change.direction != Direction::Worse && change.direction != Direction::NotCompared) continue;
            red = true;
            ++errors.metrics[fmt::format("{} of {} on {}", change.metric, change.variant, change.scene)];
        }
        errors.red += red ? 1 : 0;
    }
    return errors;
}

/// The share of results in which an error that is larger by a factor is found.
double power(const Runs& runs, double factor) {
    const auto base = relabelled(runs, range(0, seeds)), head = relabelled(runs, range(seeds, 2 * seeds), factor);
    std::set<std::pair<std::string, std::string>> all, found;
    for (const Record& record : base) all.emplace(record.scene, record.variant);
    for (const Change& change : gate::compare(base, head).changes)
        if (change.direction == Direction::Worse) found.emplace(change.scene, change.variant);
    return static_cast<double>(found.size()) / static_cast<double>(all.size());
}

std::string report(const Runs& runs) {
    Random random(2007);
    const Errors splits = errorsOf(runs, 1000, [&] {
        const std::vector<std::size_t> both = drawn(range(0, runs.size()), 2 * seeds, random);
        return std::pair(std::vector(both.begin(), both.begin() + seeds), std::vector(both.begin() + seeds, both.end()));
    });
    const Errors reseeded =
        errorsOf(runs, 200, [&] { return std::pair(range(0, seeds), drawn(range(seeds, runs.size()), seeds, random)); });
    const Record& first = runs.front().front();
    std::string text =
        fmt::format("# Seeds of one program against each other\n\n{} seeds of {} results each, commit {} "
                    "(`benchmarks/seed_splits`). Eight "
                    "seeds are the base, eight others the head; red is a comparison with anything worse or not compared.\n\n"
                    "| drawn anew | comparisons | red |\n|---|--:|--:|\n| both halves of sixteen | {} | {} |\n| the head's "
                    "seeds alone | {} | "
                    "{} |\n",
                    runs.size(), runs.front().size(), first.commit.substr(0, 12), splits.comparisons, splits.red,
                    reseeded.comparisons, reseeded.red);
    for (const Errors* errors : {&splits, &reseeded})
        for (const auto& [metric, count] : errors->metrics) text += fmt::format("\nred {} times: {}\n", count, metric);
    text += "\nWhere all errors of the head are larger, so many of the results are found worse:\n\n| factor | found "
            "|\n|--:|--:|\n";
    for (const double factor : {1.02, 1.05, 1.1, 1.2, 1.5, 2.0})
        text += fmt::format("| {} | {:.0f} % |\n", factor, 100 * power(runs, factor));
    return text;
}

int main(int argc, char** argv) {
    CLI::App app("Seeds of one program against each other.", "seed_splits");
    std::vector<std::filesystem::path> folders;
    std::filesystem::path out;
    app.add_option("folders", folders, "Folders of runs, a seed each")->required()->expected(2 * seeds, 1000);
    app.add_option("--out", out, "Write the report there");
    CLI11_PARSE(app, argc, argv);
    Runs runs;
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
        fmt::print(stderr, "seed_splits: {}\n", error.what());
        return 2;
    }
}
