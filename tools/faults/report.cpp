// Trials as a table.
#include "tools/faults/failing_calls.h"
#include "tools/faults/kills.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <set>

namespace shadowbench::faults {
namespace {

/// In the order in which they first occur.
template <typename Get>
std::vector<std::string> distinct(const std::vector<Trial>& trials, Get get) {
    std::vector<std::string> names;
    for (const Trial& trial : trials)
        if (std::ranges::find(names, get(trial)) == names.end()) names.push_back(get(trial));
    return names;
}

std::vector<Trial> of(const std::vector<Trial>& trials, const std::string& verb, const std::string& call) {
    std::vector<Trial> chosen;
    for (const Trial& trial : trials)
        if (trial.verb == verb && trial.call == call) chosen.push_back(trial);
    return chosen;
}

/// "12 of 40: 3 went on, 9 ended with 1".
std::string cell(const std::vector<Trial>& trials) {
    if (trials.empty()) return "none made";
    std::map<int, int> codes;
    std::size_t faulty = 0;
    for (const Trial& trial : trials) {
        ++codes[trial.code];
        if (!trial.faults.empty()) ++faulty;
    }
    std::vector<std::string> parts;
    for (const auto& [code, count] : codes)
        parts.push_back(code == 0 ? fmt::format("{} went on", count) : fmt::format("{} ended with {}", count, code));
    if (faulty > 0) parts.push_back(fmt::format("**{} faulty**", faulty));
    const std::string total = trials.front().of > 0 ? fmt::format(" of {}", trials.front().of) : "";
    return fmt::format("{}{}: {}", trials.size(), total, fmt::join(parts, ", "));
}

std::string faultsOf(const std::vector<Trial>& trials) {
    std::string text;
    for (const Trial& trial : trials)
        for (const std::string& fault : trial.faults)
            text += fmt::format("* {}, {} {}{}{}: {}\n", trial.verb, trial.call, trial.number,
                                trial.what.empty() ? "" : ", ", trial.what, fault);
    return text.empty() ? "None.\n" : text;
}

std::string table(const std::vector<Trial>& trials) {
    const std::vector<std::string> verbs = distinct(trials, [](const Trial& t) { return t.verb; });
    const std::vector<std::string> calls = distinct(trials, [](const Trial& t) { return t.call; });
    std::string text = fmt::format("| verb | {} |\n|---|", fmt::join(calls, " | "));
    for (std::size_t i = 0; i < calls.size(); ++i) text += "---|";
    text += "\n";
    for (const std::string& verb : verbs) {
        text += fmt::format("| {} |", verb);
        for (const std::string& call : calls) text += fmt::format(" {} |", cell(of(trials, verb, call)));
        text += "\n";
    }
    return text;
}

std::string saidBy(const std::vector<Trial>& trials) {
    std::string text;
    for (const std::string& call : distinct(trials, [](const Trial& t) { return t.call; })) {
        std::set<std::string> seen;
        text += fmt::format("\n{}:\n\n", call);
        constexpr std::size_t most = 8;
        for (const Trial& trial : trials)
            if (trial.call == call && !trial.said.empty() && seen.size() < most && seen.insert(trial.said).second)
                text += fmt::format("* {} ({}): `{}`\n", trial.verb, trial.code, trial.said);
        if (seen.empty()) text += "* nothing: all went on\n";
    }
    return text;
}

std::size_t faulty(const std::vector<Trial>& trials) {
    return static_cast<std::size_t>(std::ranges::count_if(trials, [](const Trial& t) { return !t.faults.empty(); }));
}

} // namespace

std::string callsReport(const std::vector<Trial>& trials, const std::string& command) {
    return fmt::format(
        "# Failing calls\n\n`{}`\n\nIn each trial one call of the program fails: opens and pipes with EMFILE, writes with "
        "ENOSPC, renames and flushes with EIO, forks and threads with EAGAIN; an allocation of our own code throws "
        "`std::bad_alloc`. It went on (exit code 0, and the same records and files as undisturbed), or ended with a "
        "documented "
        "code and a line. Faulty is a trial that ended otherwise, left a partial or temporary file, a temporary folder or a "
        "process, lost a record, or after which the next run did not give what an undisturbed one gives.\n\n{} trials, {} "
        "faulty.\n\n{}\n## What was said\n{}\n## Faults\n\n{}",
        command, trials.size(), faulty(trials), table(trials), saidBy(trials), faultsOf(trials));
}

std::string killsReport(const std::vector<Trial>& trials, const std::string& command) {
    const auto having = [&](const char* words) {
        return std::ranges::count_if(trials, [&](const Trial& t) {
            return std::ranges::any_of(t.faults, [&](const std::string& f) { return f.find(words) != std::string::npos; });
        });
    };
    return fmt::format(
        "# Kills\n\n`{}`\n\nEach trial sends one signal, to the verb's process or to the one of its processes "
        "and tools that makes a call, at a call that is drawn by chance; then the verb is run again.\n\n"
        "{} kills: {} left partial files, {} lost records, after {} the next run did not give what an "
        "undisturbed one gives; {} faulty in all.\n\n{}\n## Faults\n\n{}",
        command, trials.size(), having("is partial"), having("is lost"), having("the next run"), faulty(trials),
        table(trials), faultsOf(trials));
}

} // namespace shadowbench::faults
