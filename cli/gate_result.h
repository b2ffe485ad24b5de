// What `gate` and `ci` print and write of their result.
#pragma once

#include "gate/gate.h"

#include <filesystem>

namespace CLI {
class App;
}

namespace shadowbench {

/// What is written beside the page and the terminal.
struct GateFiles {
    std::filesystem::path junit, sarif, summary; // empty: not
    bool annotations = false;
};

void addGateFiles(CLI::App& verb, GateFiles& files);

/// `root`: what the paths of `shown` begin at; empty: the working directory.
ExitCode writeGate(const gate::GateResult& result, const gate::GateOptions& shown, const GateFiles& files,
                   const std::filesystem::path& root = "");

} // namespace shadowbench
