// What a program judges, as it says so itself: a gate judges by the stricter of its base's policy and its own.
#pragma once

#include "harness/gate/watchlist.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct Policy {
    std::vector<std::string> standard; // scenes that are judged with all techniques
    Watchlist watchlist;               // with what the built-in scenes expect among its bounds, for the gate's profile
};

/// The policy of a file of bounds, with this build's scenes. Throws what reading it throws.
Policy readPolicy(const std::filesystem::path& bounds, Profile profile);

/// A program by its sources, and what it judges.
struct Identity {
    std::string commit;
    bool dirty = false;
    std::string program; // hash, as records have it
    Policy policy;
};

/// This program, with the file of bounds that it was built with.
Identity ownIdentity();

/// As the verb `policy` prints it; `identityFrom` throws BadInput for what is none. What another build judges may name
/// techniques, scenes and metrics that this one does not have.
std::string toJson(const Identity& identity);
Identity identityFrom(const std::string& json);

/// Entries of `base` that `head` does not have at least as strict: with the same scene, at least the same techniques, and,
/// for a bound, the same metric with a value that is as hard to keep.
Policy loosened(const Policy& base, const Policy& head);

/// One sentence for each entry of such a policy.
std::vector<std::string> sentencesOf(const Policy& loosened);

/// Adds the entries of `more` whose metrics this build has to `policy`.
void add(const Policy& more, Policy& policy);

} // namespace shadowbench::gate
