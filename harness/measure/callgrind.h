// Instructions of steady frames, counted by Callgrind on the software rasteriser: the same to the last digit from run to
// run, where wall time is not (docs/gate.md, "Instructions").
#pragma once

#include "scene/scene.h"
#include "techniques/gl/context.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::timing {

/// Frames of one scene that one Valgrind process counts, one variant after the other.
struct CountJob {
    std::string scene; // id, or an absolute path
    std::vector<std::string> variants;
    Profile profile = Profile::Gate;
    std::uint32_t seed = 1;
};

/// Instructions a frame by variant, once shaders are compiled and history is warm: G-buffer and technique, or what a
/// level-of-detail technique draws in the third frame of the walk.
using Counts = std::map<std::string, std::uint64_t>;

/// "valgrind-3.19.0"; throws Inconclusive, naming the package to install, when there is no Valgrind.
std::string valgrindVersion();

/// Throws Inconclusive where what draws is a graphics processor, whose instructions Callgrind does not see.
void requireCountable(const gl::ContextInfo& context);

/// Runs this program's `count-frames` verb under Callgrind, in an environment of its own. `onVariant` is called on the
/// calling thread with each variant whose frame has been counted. Throws Inconclusive when Valgrind is missing or ends
/// otherwise than it should; a variant that fails in itself is absent from the counts.
Counts countInstructions(const CountJob& job, const std::function<void(std::string_view)>& onVariant);

/// The worker's half, in a process under Callgrind. It shows the scored frame and renders it with each of the variants that
/// the file lists, one a line, until it is steady; then it has one frame counted. `job.variants` is ignored.
void renderCountedFrames(const CountJob& job, const std::filesystem::path& variants);

/// The instructions that one dump of Callgrind's counts, and the trigger that the client gave it; throws BadInput for what
/// is no such file.
struct CallgrindDump {
    std::string trigger;
    std::uint64_t instructions = 0;
};
CallgrindDump parseCallgrindDump(std::string_view text);

} // namespace shadowbench::timing
