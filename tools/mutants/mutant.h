// Faults and slowdowns planted in the source, as data (mutants.toml), and what each one is run with.
#pragma once

#include "harness/gate/watchlist.h"
#include "harness/records/compare.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

/// Places on an axis at which techniques are scored, in the order in which a break is looked for.
struct Sweep {
    std::string axis;
    std::vector<double> values;
};

struct Mutant {
    std::string id;
    std::string what; // in one sentence
    std::filesystem::path file;
    std::string find, replace;
    std::vector<std::string> techniques; // variants, at least one
    std::vector<std::string> scenes;     // empty: those that the gate judges; exactly one with a sweep
    std::optional<Sweep> sweep;
    gate::Class expected = gate::Class::Labels; // in which it must be detected
    std::string survives;                       // why it is not detected, if that is known

    [[nodiscard]] bool isSlowdown() const { return expected == gate::Class::Instructions; }
};

/// Throws BadInput, naming file, line and key, for what is no list of mutants with distinct ids.
std::vector<Mutant> readMutants(const std::filesystem::path& file);

/// The mutants, each that names no scenes now with the standard ones and those that the gate judges all its techniques on.
std::vector<Mutant> onTheGatesScenes(std::vector<Mutant> mutants, const gate::Watchlist& watchlist);

/// The mutants whose id matches one of the globs; all without a glob. Throws BadInput for a glob that matches none.
std::vector<Mutant> matching(const std::vector<Mutant>& mutants, const std::vector<std::string>& globs);

/// `source` with the fault in it. Throws BadInput naming the mutant unless `find` stands there exactly once.
std::string planted(const Mutant& mutant, std::string_view source);

/// Verb and options of `shadowbench` that detect the mutant; the same for mutants that share a base.
std::vector<std::string> arguments(const Mutant& mutant);

} // namespace shadowbench::mutants
