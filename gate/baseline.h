// The baseline of a gate: what `--base` names.
#pragma once

#include "base/progress.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

/// A program to measure, or records of one that was measured before.
struct Baseline {
    enum class Kind { Program, Records };
    Kind kind = Kind::Program;
    std::filesystem::path file; // the executable, or the record file
    std::string name;           // as reports name it: what was asked for
};

/// `text` is a build folder or the program in it, a record file or the folder of a run, or else a git revision of the
/// repository that holds the working directory: that commit is built (once; kept in `cache` by its hash and the compiler),
/// and `progress` gets the build's output line by line. Throws Inconclusive, naming what was tried, when it is none of them
/// or cannot be built: without a baseline nothing is judged.
Baseline findBaseline(const std::string& text, const std::filesystem::path& cache, const Progress& progress);

} // namespace shadowbench::gate
