// The programs that a gate compares: builds of shadowbench of this or another commit, started as a user would.
#pragma once

#include "base/error.h"
#include "base/progress.h"
#include "gate/policy.h"
#include "harness/records/record.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::gate {

/// One `run` or `sweep` of a program.
struct Step {
    std::string name;                    // as reports name it: "overlapping-occluders, instructions"
    std::vector<std::string> arguments;  // without --technique, --out, --cache and --quiet
    std::vector<std::string> techniques; // canonical names
    std::string records;                 // file or, of a part of a run, folder that it leaves in --out
    std::string inputs = {};             // content of the files that `arguments` name, and keys of truths
    /// It calls renderers that are not ours. They see the environment and the limits of this process, as with the verb
    /// `run`. Nobody can hash them: such a step is for `run`, which keeps nothing.
    bool callsRenderers = false;
    std::string scene = {}; // id of what `measure` runs …
    std::uint32_t seed = 1; // … and seed of its records

    [[nodiscard]] bool isSweep() const { return records == "sweep.jsonl"; }
    [[nodiscard]] bool isPart() const { return records == "cells"; } // makes no pages

    /// The step whatever its techniques are.
    [[nodiscard]] std::string place() const;
};

struct StepTime {
    std::string name;
    double seconds = 0;
};

/// What a program's steps gave.
struct Measured {
    std::vector<std::vector<Record>> ofSteps;
    std::vector<StepTime> times; // of the steps that were not already there

    [[nodiscard]] std::vector<Record> records() const;
};

/// A step's records by its techniques.
std::map<std::string, std::vector<Record>> byTechnique(const std::vector<Record>& records);

/// What a program's `shader-cost` left.
struct ShaderFigures {
    ExitCode code = ExitCode::Pass;
    std::string last;                          // line that it printed
    std::optional<std::filesystem::path> file; // of its lines; nothing: it left none
    std::vector<std::string> errors;           // a sentence for each variant that has no figures
};

class MeasuredProgram {
public:
    /// `file`: the executable. Its records are kept in `cache`, under a hash of what can decide them (gate/reach.h; of a
    /// program that does not say, the program), Mesa, Valgrind and processor: nothing is measured twice. Throws Inconclusive
    /// when it cannot be read.
    MeasuredProgram(const std::filesystem::path& file, const std::filesystem::path& cache);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// What it is and judges; nothing of a build from before there was the verb `policy`.
    [[nodiscard]] const std::optional<BuildInfo>& build() const { return build_; }

    /// Hash of the executable.
    [[nodiscard]] const std::string& content() const { return content_; }

    /// Whether the program has the variant (its technique, all its parameters and their values), or the built-in scene.
    [[nodiscard]] bool knowsVariant(const std::string& variant) const;
    [[nodiscard]] bool knowsScene(const std::string& id) const;

    /// The variants that it shows, in the order of its catalogue, as it lists them.
    [[nodiscard]] std::vector<std::string> variants() const;

    /// Runs of the steps what no earlier call has measured, or what somebody has changed since, on all cores, and returns
    /// the records of all steps. A step that was killed is resumed. Throws Inconclusive when a step fails otherwise than in
    /// some of its cells.
    Measured measure(const std::vector<Step>& steps, const Progress& progress) const;

    /// The same whatever is kept. Of that, nothing is changed.
    Measured measureAgain(const std::vector<Step>& steps, const Progress& progress) const;

    [[nodiscard]] bool isKept(const Step& step, const std::string& technique) const;

    /// From now on nothing counts that was measured of other programs.
    void distrustReach();

    /// Runs one step in `out`, whatever was run before. Cells that fail have records that say so. Throws Inconclusive when
    /// it left no records, or a cell of a part is worth a retry.
    void run(const Step& step, const std::filesystem::path& out, int programs, const Progress& progress) const;

    /// Runs `shader-cost` in `out`, which keeps itself what it drew and compiled: of those of `variants` that the program
    /// has, of all if there are none.
    ShaderFigures shaderFigures(const std::vector<std::string>& variants, const std::filesystem::path& out,
                                const Progress& progress) const;

private:
    using Results = std::map<std::string, std::vector<Record>>; // by technique

    Measured measured(const std::vector<Step>& steps, bool again, const Progress& progress) const;
    /// What decides a result; "" where the program does not say.
    [[nodiscard]] std::string reachOf(const Step& step, const std::string& technique) const;
    [[nodiscard]] std::filesystem::path fileOf(const Step& step, const std::string& technique) const;
    [[nodiscard]] std::optional<std::vector<Record>> kept(const Step& step, const std::string& technique) const;
    void keep(const Step& step, const std::string& technique, const std::vector<Record>& records) const;
    /// Where it runs.
    [[nodiscard]] std::filesystem::path folderOf(const Step& step) const;
    /// Runs the step and keeps what it gives without error, unless `again`.
    Results results(const Step& step, bool again, int programs, const Progress& progress) const;

    struct Technique {
        std::string id;
        std::map<std::string, std::string> parameters; // with their values: "a|b", "1…8"
        std::vector<std::string> variants;             // parameter strings
    };

    std::filesystem::path file_, cache_, runs_;
    std::string content_, surroundings_;
    std::optional<BuildInfo> build_;
    std::vector<std::string> scenes_;
    std::vector<Technique> techniques_;
};

} // namespace shadowbench::gate
