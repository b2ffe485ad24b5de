#include "tools/mutants/operators/suite.h"

#include "base/error.h"
#include "base/hash.h"

#include <algorithm>
#include <fmt/format.h>
#include <toml++/toml.h>

namespace shadowbench::mutants {
namespace {

/// The line around `offset`, without what indents it.
std::string_view lineAround(std::string_view source, std::size_t offset) {
    const std::size_t begin = source.rfind('\n', offset) + 1;
    const std::string_view line = source.substr(begin, source.find('\n', offset) - begin);
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

/// In one line, as code in a table's cell.
std::string cell(std::string_view code) {
    std::string text = "`";
    for (const char c : code)
        if (c == '|')
            text += "\\|";
        else if (c != '\n' && (c != ' ' || text.back() != ' '))
            text += c;
    return text + "`";
}

std::ptrdiff_t count(const std::vector<OperatorMutant>& mutants, std::size_t judge, End end) {
    return std::ranges::count_if(mutants, [&](const OperatorMutant& m) { return m.judge == judge && m.end == end; });
}

std::string row(const OperatorMutant& mutant, const std::map<std::string, std::string>& why) {
    const auto found = why.find(mutant.id);
    const std::string after = mutant.point.after.empty() ? "nothing" : cell(mutant.point.after);
    return fmt::format("| {} | {}:{} | {} | {} → {} | {}{} |\n", mutant.id, mutant.file, mutant.line, mutant.point.operation,
                       cell(mutant.before), after, mutant.end == End::NotReached ? "no test reaches it; " : "",
                       found == why.end() ? "**not explained**" : found->second);
}

} // namespace

const std::vector<Judge>& judges() {
    static const std::vector<Judge> all{
        {"metrics", {"harness/metrics/"}, {"test_harness_metrics"}},
        {"records", {"harness/records/"}, {"test_harness_records", "test_gate"}}, // the gate's tests compare records
        {"gate", {"gate/"}, {"test_gate", "test_gate_programs"}},
        {"studies", {"studies/"}, {"test_studies"}},
        {"history", {"history/"}, {"test_history"}},
        {"summary",
         {"report/summary.cpp", "report/terminal_summary.cpp", "report/table.cpp", "report/text_table.cpp",
          "report/doubts.cpp"},
         {"test_report"}},
        {"certify", {"groundtruth/certify/"}, {"test_groundtruth_certify"}},
    };
    return all;
}

std::vector<OperatorMutant> mutantsOf(std::size_t judge, const std::string& file, const std::string& source,
                                      const std::vector<Point>& points) {
    std::map<std::string, int> seen; // equal lines are told apart by their order
    std::vector<OperatorMutant> mutants;
    for (const Point& point : points) {
        const std::string before = source.substr(point.begin, point.end - point.begin);
        const std::string name =
            fmt::format("{}\n{}\n{}\n{}\n{}", file, point.operation, lineAround(source, point.begin), before, point.after);
        const std::string id = fmt::format("{:016x}", hash64(fmt::format("{}\n{}", name, seen[name]++))).substr(0, 8);
        const auto line = static_cast<std::size_t>(
            std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(point.begin), '\n'));
        mutants.push_back({id, judge, file, line + 1, before, point});
    }
    return mutants;
}

void shuffle(std::vector<OperatorMutant>& mutants, std::uint64_t seed) {
    std::ranges::sort(mutants, {},
                      [&](const OperatorMutant& m) { return std::pair(hash64(fmt::format("{} {}", seed, m.id)), m.id); });
}

std::map<std::string, std::string> readSurvivors(const std::filesystem::path& file) {
    try {
        std::map<std::string, std::string> result;
        for (const auto& [id, why] : toml::parse_file(file.string())) {
            if (!why.is_string()) throw BadInput(fmt::format("{}: {} has no sentence", file.string(), id.str()));
            result.emplace(id.str(), **why.as_string());
        }
        return result;
    } catch (const toml::parse_error& error) {
        throw BadInput(fmt::format("{}: {}", file.string(), error.description()));
    }
}

double killedShare(const std::vector<OperatorMutant>& mutants) {
    const auto killed = std::ranges::count(mutants, End::Killed, &OperatorMutant::end);
    return static_cast<double>(killed) / static_cast<double>(std::max<std::size_t>(mutants.size(), 1));
}

std::string operatorsReport(const std::vector<OperatorMutant>& mutants, const std::map<std::string, std::string>& why,
                            const std::string& source) {
    const auto explained = std::ranges::count_if(
        mutants, [&](const OperatorMutant& mutant) { return mutant.end != End::Killed && why.contains(mutant.id); });
    const auto others = static_cast<double>(mutants.size()) - static_cast<double>(explained);
    std::string text =
        fmt::format("# Operator mutants of metrics, records and gate\n\nMade by `operator_mutants` ({}): {:.1f} % of {} "
                    "mutants are killed by the unit tests of the part that they change; of those without a reason below, "
                    "{:.1f} %.\n\n| part | mutants | killed | not reached | "
                    "share killed |\n"
                    "|---|--:|--:|--:|--:|\n",
                    source, 100 * killedShare(mutants), mutants.size(),
                    others > 0 ? 100 * killedShare(mutants) * static_cast<double>(mutants.size()) / others : 100);
    for (std::size_t judge = 0; judge < judges().size(); ++judge) {
        const auto killed = count(mutants, judge, End::Killed), missed = count(mutants, judge, End::NotReached);
        const auto all = killed + missed + count(mutants, judge, End::Survives);
        text += fmt::format("| {} | {} | {} | {} | {:.1f} % |\n", judges()[judge].name, all, killed, missed,
                            100.0 * static_cast<double>(killed) / static_cast<double>(std::max<std::ptrdiff_t>(all, 1)));
    }
    text += "\n## Survivors\n\n| id | where | operator | change | why no test kills it |\n|---|---|---|---|---|\n";
    for (const OperatorMutant& mutant : mutants)
        if (mutant.end != End::Killed) text += row(mutant, why);
    return text;
}

} // namespace shadowbench::mutants
