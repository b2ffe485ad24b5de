// Where and with what a record was made.
#pragma once

#include "harness/records/record.h"
#include "techniques/gl/context.h"

#include <string>

namespace shadowbench {

Environment environmentOf(const gl::ContextInfo& context);

/// The commit this program was built from, and whether tracked files had been changed.
struct Commit {
    std::string hash;
    bool dirty;
};
Commit builtFrom();

/// Hashes of the sources and the compiler that this program was built from, and of those sources that score: two programs
/// with one hash do the same, whatever their commits.
std::string programHash();
std::string metricCodeHash();

/// The version of the project, and the commit: "0.1.0 (commit 79e0c196bffc, with changes)".
std::string programVersion();

/// Now, ISO 8601 in UTC to the second.
std::string timeNow();

} // namespace shadowbench
