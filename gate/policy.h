// What a program judges, as it says so itself: a gate judges by the stricter of its base's policy and its own.
#pragma once

#include "gate/gate_config.h"
#include "gate/paired.h"
#include "gate/reach.h"
#include "harness/records/rules.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

struct Policy {
    std::vector<std::string> standard; // scenes that are judged with all techniques
    GateConfig config;                 // with what the built-in scenes expect among its bounds, for the gate's profile
    Rules rules = ownRules();          // those of older programs, which do not state them, are this build's
    TimeRule time = {};
};

/// Where a clone has its file of bounds, from the root.
inline constexpr const char* usualBounds = "gate/bounds.toml";

/// The policy of a file of bounds, with this build's scenes; where the usual one is missing, as it is outside a clone, the
/// one that this program carries. Throws Inconclusive where another one is missing, and what reading it throws.
Policy readPolicy(const std::filesystem::path& bounds, Profile profile);

/// A program by its sources, and what it judges.
struct BuildInfo {
    std::string commit;
    bool dirty = false;
    std::string program; // hash, as records have it
    Policy policy;
    Reach reach = {}; // empty of older programs
};

/// This program, with the file of bounds that it was built with.
BuildInfo ownBuildInfo();

/// As the verb `policy` prints it; `buildInfoFrom` throws BadInput for what is none. What another build judges may name
/// techniques, scenes and metrics that this one does not have.
std::string toJson(const BuildInfo& build);
BuildInfo buildInfoFrom(const std::string& json);

/// What makes `head` judge at least as strictly as `base`: entries of the base that the head does not have with the same
/// scene, at least the same techniques and, for a bound, the same metric with a value that is as hard to keep; and the
/// stricter of each number.
struct Union {
    Policy policy;
    std::vector<std::string> loosened; // a sentence for each entry or number of the base that is gone or looser in the head,
                                       // and for each waiver that the head alone has
};
Union unite(const Policy& base, const Policy& head);

/// The sentences alone: none where `head` is as strict as `base`.
std::vector<std::string> loosened(const Policy& base, const Policy& head);

} // namespace shadowbench::gate
