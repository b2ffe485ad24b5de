// Renderers that are not ours as techniques: their cells call the command on the exported scene and score what it wrote.
#pragma once

#include "harness/cells/external_techniques.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace shadowbench::foreign {

struct RendererOptions {
    std::filesystem::path
        logs;             // where what a renderer that failed said is kept (harness/cells/renderer_log.h); empty: nowhere
    std::string revision; // of the renderers; empty: as git describes the folder of each one's file
};

/// The renderers of all files (renderer.h), each called with the environment variables that this process has now. Null for
/// no file. Throws BadInput as readRenderers, and for an id that two files have.
std::shared_ptr<const ExternalTechniques> renderersOf(const std::vector<std::filesystem::path>& files,
                                                      const RendererOptions& options = {});

} // namespace shadowbench::foreign
