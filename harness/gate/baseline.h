// What `gate --base` names.
#pragma once

#include "base/progress.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

/// A program to measure, or records of one that was.
struct Base {
    enum class Kind { Program, Records };
    Kind kind = Kind::Program;
    std::filesystem::path file; // the executable, or the record file
    std::string name;           // for people: what was asked for
};

/// `text` is a build folder or the program in it, a record file or the folder of a run, or else a git revision of the
/// repository that holds the working directory: that commit is built (once; kept in `cache` by its hash), for which
/// `progress` is told what the build says. Throws Inconclusive, naming what was tried, when it is none of them or cannot be
/// built: without a base nothing is judged.
Base findBase(const std::string& text, const std::filesystem::path& cache, const Progress& progress);

} // namespace shadowbench::gate
