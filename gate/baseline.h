// The baseline of a gate: what `--base` names.
#pragma once

#include "base/progress.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

/// A program to measure, records of one that was measured before, or a commit whose sources make the head's program.
struct Baseline {
    enum class Kind { Program, Records, HeadsProgram };
    Kind kind = Kind::Program;
    std::filesystem::path file; // the executable, or the record file
    std::string name;           // as reports name it: what was asked for
    std::string commit = {};    // of the head's program
};

/// `text` is a build folder or the program in it, a record file or the folder of a run, or else a git revision of the
/// repository that holds the working directory: that commit is built (once; kept in `cache` by its hash and the compiler),
/// and `progress` gets the build's output line by line. Only its sources are hashed where that gives `program`, the head's
/// hash of its own (BuildInfo); with "" it is built whatever it is. Throws Inconclusive, naming what was tried, when it is
/// none of them or cannot be built: without a baseline nothing is judged.
Baseline findBaseline(const std::string& text, const std::filesystem::path& cache, const std::string& program,
                      const Progress& progress);

} // namespace shadowbench::gate
