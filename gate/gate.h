// The gate: measures a base and this program on the same cells and decides whether this one is worse (docs/gate.md).
#pragma once

#include "base/error.h"
#include "gate/measured_program.h"
#include "gate/policy.h"
#include "harness/records/compare.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench {
class ExternalTechniques;
}

namespace shadowbench::gate {

struct GateOptions {
    std::string base;                                   // see findBaseline
    std::filesystem::path head = "/proc/self/exe";      // the program that is judged
    std::vector<std::string> scenes;                    // ids or files; empty: the standard scenes
    std::vector<std::string> techniques;                // variants or globs; empty: all
    std::vector<std::filesystem::path> externalFiles;   // of renderers that are not ours …
    std::shared_ptr<const ExternalTechniques> external; // … and their techniques; null: none. The base must be records
    Profile profile = Profile::Gate;
    std::filesystem::path bounds = usualBounds;
    std::filesystem::path out = "results/gate"; // of the report and the pictures of failing cells
    std::filesystem::path cache;                // empty: the default
    std::uint32_t seed = 1;
    bool instructions = true, time = true, shader = true; // which costs are judged
    bool all = false;                                     // also what no change can have reached
    bool sameProgram = false;                             // base and head may be one program
    bool quiet = false;
};

/// One failing cell as it was drawn for the report.
struct FailurePictures {
    std::string scene, variant;
    std::filesystem::path head, base;             // folders of pictures, empty where it has none
    std::optional<Record> headRecord, baseRecord; // of the drawing
};

/// What a program that is not ours said before it failed.
struct FailureLog {
    std::string what;               // that failed, as a sentence's beginning
    std::filesystem::path file;     // with all that it said
    std::vector<std::string> lines; // the last ones
};

struct GateResult : Comparison {
    std::string base, head;               // as reports name them
    std::vector<std::string> loosened;    // sentences: what the base judges more strictly, and what only the head waives
    std::vector<std::string> notCompared; // sentences: what could not be judged, and why
    std::vector<std::string> notes;       // sentences: what was left out on purpose, or is uncertain
    std::vector<FailurePictures> pictures;
    std::vector<FailureLog> logs;
    std::vector<StepTime> times; // of the parts, some of which ran side by side
    double seconds = 0;          // of all

    /// Anything that could not be judged is inconclusive, whatever else is worse.
    [[nodiscard]] ExitCode code() const;
};

/// Throws BadInput for what the user named wrongly, Inconclusive when a program, tool or the base is missing or fails.
GateResult gate(const GateOptions& options);

/// Two sets of records as a gate's result: this build's rules judge. One program on both sides decides nothing, unless
/// `sameProgram`.
GateResult comparedRecords(const std::vector<Record>& base, const std::vector<Record>& head, bool sameProgram = false);

/// Where a gate leaves what `shader-cost` said, in folders `base` and `head`.
std::filesystem::path shaderFolder(const GateOptions& options);

/// The command that shows a change again. `base` as the user named it.
std::string reproduction(const Change& change, const GateOptions& options);

} // namespace shadowbench::gate
