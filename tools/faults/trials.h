// What becomes of a verb that is disturbed, and of the next run; whether its files outlive a power cut; many verbs at once.
#pragma once

#include "tools/faults/sandbox.h"

namespace shadowbench::faults {

/// How a verb was disturbed, and what came of it.
struct Trial {
    std::string verb;
    std::string call;                 // "open", …, "SIGTERM to the verb"
    std::uint64_t number = 0, of = 0; // the call, and how many an undisturbed verb makes: 0, nobody has counted
    std::string what{};               // point that failed, or at which the signal was sent
    int code = 0;
    std::string said{};   // its line, where it did not end with 0
    Texts faults{};       // what should not have come of it, a sentence each
    bool reached = false; // it made so many calls
};

/// Disturbs the verb, then runs it again.
Trial disturb(Sandbox& sandbox, const Verb& verb, const Wanted& wanted, std::uint64_t of);

/// At most `most` of the numbers 1 … of, evenly, with the first and the last.
std::vector<std::uint64_t> spread(std::uint64_t of, std::uint64_t most);

/// What else is found out: lines of a page, and faults, a sentence each.
struct Findings {
    Texts lines, faults;
};

/// Whether what a verb writes outlives a power cut: flushed before it gets its name, and the folder after. A row of a table.
void checkOrder(Sandbox& sandbox, const Verb& verb, Findings& findings);

/// So many runs, scores, gates, merges, reports and prunes of one cache and one output, at the same time.
Findings workTogether(const std::filesystem::path& program, int processes);

/// Pages in Markdown: tables of verbs and calls, what was said, and all faults.
std::string callsReport(const std::vector<Trial>& trials, const std::string& command);
std::string killsReport(const std::vector<Trial>& trials, const std::string& command);
std::string orderReport(const Findings& findings, const std::string& command);
std::string togetherReport(const Findings& findings, const std::string& command);

} // namespace shadowbench::faults
