// Machine code of shaders that outlives a process: the same techniques are compiled for scene after scene, for both programs
// of a gate and for every run. Mesa names an entry by shader, state, its own build and the processor.
#pragma once

#include "techniques/gl/context.h"

#include <filesystem>
#include <memory>
#include <system_error>

namespace shadowbench {

/// A context for a run. If nothing is timed, its shaders are kept in the folder `shaders` of `cache`, the folder of
/// references: writing them takes a thread of Mesa's, which times and counts had better not meet.
inline std::unique_ptr<gl::Context> contextOfRun(const std::filesystem::path& cache, bool timed) {
    gl::ContextOptions options;
    if (!timed) {
        std::error_code failed;                             // then nothing is kept
        std::filesystem::create_directories(cache, failed); // Mesa makes the last folder alone
        options.shaderCache = (cache / "shaders").string();
    }
    return gl::Context::create(options);
}

} // namespace shadowbench
