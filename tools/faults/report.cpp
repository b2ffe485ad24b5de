// Trials as tables.
#include "tools/faults/trials.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>

namespace shadowbench::faults {
namespace {

/// In the order in which they first occur.
Texts distinct(const std::vector<Trial>& trials, std::string Trial::*member) {
    Texts names;
    for (const Trial& trial : trials)
        if (std::ranges::find(names, trial.*member) == names.end()) names.push_back(trial.*member);
    return names;
}

/// "12 of 40: 3 went on, 9 ended with 1".
std::string cell(const std::vector<Trial>& trials, const std::string& verb, const std::string& call) {
    std::map<int, int> codes;
    std::uint64_t count = 0, of = 0, faulty = 0;
    for (const Trial& trial : trials) {
        if (trial.verb != verb || trial.call != call) continue;
        ++count;
        ++codes[trial.code];
        of = trial.of;
        faulty += trial.faults.empty() ? 0 : 1;
    }
    if (count == 0) return "none made";
    Texts parts;
    for (const auto& [code, times] : codes)
        parts.push_back(code == 0 ? fmt::format("{} went on", times) : fmt::format("{} ended with {}", times, code));
    if (faulty > 0) parts.push_back(fmt::format("**{} faulty**", faulty));
    return fmt::format("{}{}: {}", count, of > 0 ? fmt::format(" of {}", of) : "", fmt::join(parts, ", "));
}

Texts faultsOf(const std::vector<Trial>& trials) {
    Texts faults;
    for (const Trial& trial : trials)
        for (const std::string& fault : trial.faults)
            faults.push_back(fmt::format("{}, {} {}, {}: {}", trial.verb, trial.call, trial.number, trial.what, fault));
    return faults;
}

std::string table(const std::vector<Trial>& trials) {
    const Texts calls = distinct(trials, &Trial::call);
    std::string text = fmt::format("| verb | {} |\n|---|", fmt::join(calls, " | "));
    for (std::size_t i = 0; i < calls.size(); ++i) text += "---|";
    for (const std::string& verb : distinct(trials, &Trial::verb)) {
        text += fmt::format("\n| {} |", verb);
        for (const std::string& call : calls) text += fmt::format(" {} |", cell(trials, verb, call));
    }
    return text + "\n";
}

std::string saidBy(const std::vector<Trial>& trials) {
    std::string text;
    for (const std::string& call : distinct(trials, &Trial::call)) {
        constexpr std::size_t most = 8;
        std::set<std::string> seen;
        text += fmt::format("\n{}:\n\n", call);
        for (const Trial& trial : trials)
            if (trial.call == call && !trial.said.empty() && seen.size() < most && seen.insert(trial.said).second)
                text += fmt::format("* {} ({}): `{}`\n", trial.verb, trial.code, trial.said);
        if (seen.empty()) text += "* nothing: all went on\n";
    }
    return text;
}

/// How many have a fault with these words; "": any.
std::ptrdiff_t faulty(const std::vector<Trial>& trials, const char* words = "") {
    return std::ranges::count_if(trials, [&](const Trial& trial) {
        return std::ranges::any_of(trial.faults, [&](const std::string& fault) { return fault.find(words) != fault.npos; });
    });
}

std::string page(const char* title, const std::string& command, const std::string& body, const Texts& faults) {
    return fmt::format("# {}\n\n`{}`\n\n{}\n## Faults\n\n{}", title, command, body,
                       faults.empty() ? "None.\n" : fmt::format("* {}\n", fmt::join(faults, "\n* ")));
}

} // namespace

std::string callsReport(const std::vector<Trial>& trials, const std::string& command) {
    const std::string body = fmt::format(
        "In each trial one call of the program fails: opens and pipes with EMFILE, writes with ENOSPC, renames and flushes "
        "with EIO, forks and threads with EAGAIN; an allocation of our own code throws `std::bad_alloc`. It went on (exit "
        "code 0, and the same records and files as undisturbed), or ended with a documented code and a line. Faulty is a "
        "trial that ended otherwise, left a partial or temporary file, a temporary folder or a process, lost a record, or "
        "after which the next run did not give what an undisturbed one gives.\n\n{} trials, {} faulty.\n\n{}\n"
        "## What was said\n{}",
        trials.size(), faulty(trials), table(trials), saidBy(trials));
    return page("Failing calls", command, body, faultsOf(trials));
}

std::string killsReport(const std::vector<Trial>& trials, const std::string& command) {
    const std::string body = fmt::format(
        "Each trial sends one signal, to the verb's process or to the one of its processes that makes a call, at a call "
        "that "
        "is drawn by chance; then the verb is run again.\n\n{} kills: {} left partial files, {} lost records, after {} the "
        "next run did not give what an undisturbed one gives; {} faulty in all.\n\n{}",
        trials.size(), faulty(trials, "is partial"), faulty(trials, "is lost"), faulty(trials, "the next run"),
        faulty(trials), table(trials));
    return page("Kills", command, body, faultsOf(trials));
}

std::string orderReport(const Findings& findings, const std::string& command) {
    const std::string body =
        fmt::format("Of each verb: every file gets its name by a rename, is flushed before it, and its folder after it. "
                    "Pages, tables and "
                    "charts, which the same command makes again of the records, need not be flushed.\n\n"
                    "| verb | flushed, renamed, folder flushed | made again | faults |\n|---|--:|--:|--:|\n{}\n",
                    fmt::join(findings.lines, "\n"));
    return page("What a power cut would leave", command, body, findings.faults);
}

std::string togetherReport(const Findings& findings, const std::string& command) {
    const std::string body =
        fmt::format("Verbs at once on one cache and one output: every one ends with 0, what they write is "
                    "whole at any moment, no record is lost.\n\n* {}\n",
                    fmt::join(findings.lines, "\n* "));
    return page("At the same time", command, body, findings.faults);
}

} // namespace shadowbench::faults
