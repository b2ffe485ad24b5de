// A gate's result in SARIF, the form in which code hosts take findings.
#pragma once

#include "gate/gate.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

/// SARIF 2.1.0: an error for each cell that is worse and a warning for each that is not compared, the worst first, each at
/// the renderer's entry in its file of `options`, or where techniques are listed; what is of no cell as a notification of
/// the tool. `root`: what the paths of `options` begin at.
std::string sarif(const GateResult& result, const GateOptions& options, const std::filesystem::path& root);

} // namespace shadowbench::gate
