// Calls a renderer that is not ours on an exported scene, and finds what it wrote.
#pragma once

#include "base/process.h"
#include "harness/foreign/renderer.h"
#include "harness/records/record.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::foreign {

/// What a renderer left in its folder.
struct Rendered {
    std::vector<FrameFiles> frames;       // as asked for
    std::optional<ReportedCost> reported; // by its timing.json
};

/// The program that a renderer's command begins with. Throws Inconclusive when it is not there or may not be run.
std::filesystem::path programOf(const Renderer& renderer);

/// Runs the command with the scene's folder, the frames and the empty folder `out`, in a process group of its own, with
/// `variables` (NAME=value) and those that the renderer asks for. No process that it started is left. Throws Inconclusive
/// with a sentence about "its command" when it cannot be started, is late, floods its output, fails, or leaves no image of a
/// frame or several; Inconclusive too when the user interrupts. `onLine` gets what it says, line by line.
Rendered callRenderer(const Renderer& renderer, const std::filesystem::path& scene, const std::vector<int>& frames,
                      const std::filesystem::path& out, std::vector<std::string> variables, const OnLine& onLine = {});

/// What `out` holds of the frames and of costs. Throws as above.
Rendered foundIn(const std::filesystem::path& out, const std::vector<int>& frames);

} // namespace shadowbench::foreign
