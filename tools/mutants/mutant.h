// Faults, slowdowns and benign changes planted in the source, as data (mutants.toml), and how each must be found.
#pragma once

#include "gate/gate_config.h"
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

/// By what a fault is found.
enum class Means {
    Gate,    // its records are compared with those of the program without the fault
    Refusal, // no records come, a cell ends as an error, or the records are refused for comparison
    Truth,   // a golden reference, computed again, is another one, or its certificate refuses it
    Test,    // a test of CTest fails
    Shader,  // the machine code of its shaders is compared, as the gate does; nothing is drawn for accuracy
};

struct Mutant {
    std::string id;
    std::string what; // in one sentence
    std::filesystem::path file;
    std::string find, replace;
    Means means = Means::Gate;
    std::string target; // of Truth: scene, truth and, if one is meant, frame, with slashes between; of Test: its name
    std::vector<std::string> techniques; // variants, of what is found by records or shaders at least one
    std::string pass;                    // of Shader: that must be named; "" of a benign change
    std::vector<std::string> scenes;     // empty: those that the gate judges; exactly one with a sweep
    std::optional<Sweep> sweep;
    std::optional<gate::Class> expected; // of Gate and Shader: in which it must be detected; nothing for a benign change
    bool benign = false;                 // no fault: nothing may be worse
    std::vector<std::string> byChance;   // "scene variant": cells that the gate measures with several seeds
    std::string survives;                // why it is not detected, or why a benign change is, if that is known

    [[nodiscard]] bool isSlowdown() const { return expected == gate::Class::Instructions; }
    [[nodiscard]] bool makesRecords() const { return means == Means::Gate || means == Means::Refusal; }
};

/// Throws BadInput, naming file, line and key, for what is no list of mutants with distinct ids.
std::vector<Mutant> readMutants(const std::filesystem::path& file);

/// The mutants, each that names no scenes now with the standard ones and those that the gate judges all its techniques on;
/// and with its cells that the gate measures with several seeds, unless instructions alone tell.
std::vector<Mutant> onTheGatesScenes(std::vector<Mutant> mutants, const gate::GateConfig& config);

/// The mutants whose id matches one of the globs; all without a glob. Throws BadInput for a glob that matches none.
std::vector<Mutant> matching(const std::vector<Mutant>& mutants, const std::vector<std::string>& globs);

/// Every `count`th mutant from the `index`th on; "index/count", counted from 1. Throws BadInput for what is none.
std::vector<Mutant> shardOf(const std::vector<Mutant>& mutants, const std::string& shard);

/// `source` with the fault in it. Throws BadInput naming the mutant unless `find` stands there exactly once.
std::string planted(const Mutant& mutant, std::string_view source);

/// How a mutant must be found, as the list and the report say it: "leak", "refusal", "truth:simple/hard".
std::string expectedText(const Mutant& mutant);

/// Verb and options of `shadowbench` that detect the mutant, or the name of the test; the same for mutants that share a
/// base.
std::vector<std::string> arguments(const Mutant& mutant);

} // namespace shadowbench::mutants
