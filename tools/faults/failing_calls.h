// What becomes of a verb when one of its calls fails, and of the next run.
#pragma once

#include "tools/faults/sandbox.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::faults {

/// How a verb was disturbed, and what came of it.
struct Trial {
    std::string verb;
    std::string call; // "open", …, "allocation"
    std::uint64_t number = 0, of = 0;
    std::string what; // path that the call was about
    int code = 0;
    std::string said;                // its line, where it did not end with 0
    std::vector<std::string> faults; // what should not have come of it, a sentence each
};

/// The calls that count: those of the program itself (not of tools that it starts), but for what the system's libraries open
/// for themselves, Mesa's own cache of shaders, and what is written to standard error.
bool isOwn(const Call& call);

/// How many own calls of each kind an undisturbed run makes.
std::map<Kind, std::uint64_t> countCalls(Sandbox& sandbox, const Verb& verb);

/// Lets the `number`-th own call of the kind fail. `lasting`: and all after it.
Trial failCall(Sandbox& sandbox, const Verb& verb, Kind kind, std::uint64_t number, std::uint64_t of, bool lasting);

/// Lets the `number`-th allocation of our code fail; nothing if it makes fewer.
std::optional<Trial> failAllocation(Sandbox& sandbox, const Verb& verb, std::uint64_t number);

/// At most `most` of the numbers 1 … of, evenly, with the first and the last.
std::vector<std::uint64_t> spread(std::uint64_t of, std::uint64_t most);

/// The table of verbs and calls, what was said, and all faults, in Markdown.
std::string callsReport(const std::vector<Trial>& trials, const std::string& command);

} // namespace shadowbench::faults
