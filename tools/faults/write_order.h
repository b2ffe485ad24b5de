// Whether what a verb writes outlives a power cut: flushed before it gets its name, and the folder after.
#pragma once

#include "tools/faults/sandbox.h"

#include <string>
#include <utility>
#include <vector>

namespace shadowbench::faults {

struct WriteOrder {
    int renames = 0;                 // of files that must last
    int madeAgain = 0;               // of those that the same command makes again: pages, tables and charts
    std::vector<std::string> faults; // a sentence each
};

WriteOrder writeOrderOf(Sandbox& sandbox, const Verb& verb);

/// A line a verb, and all faults, in Markdown.
std::string orderReport(const std::vector<std::pair<std::string, WriteOrder>>& verbs, const std::string& command);

} // namespace shadowbench::faults
