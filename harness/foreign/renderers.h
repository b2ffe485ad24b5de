// Renderers that are not ours as techniques: their cells call the command on the exported scene and score what it wrote.
#pragma once

#include "harness/cells/external_techniques.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace shadowbench::foreign {

/// The renderers of all files (renderer.h), each called with the environment variables that this process has now. Null for
/// no file. Throws BadInput as readRenderers, and for an id that two files have.
std::shared_ptr<const ExternalTechniques> renderersOf(const std::vector<std::filesystem::path>& files);

} // namespace shadowbench::foreign
