// The page of a gate's verdict by itself.
#pragma once

#include "gate/gate.h"

#include <filesystem>

namespace shadowbench::site {

/// Writes gate.html, with what it needs beside it, into the folder of the gate's report; returns its path.
std::filesystem::path writeGateSite(const gate::GateResult& result, const gate::GateOptions& options);

} // namespace shadowbench::site
