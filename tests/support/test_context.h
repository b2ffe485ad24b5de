// The GL context of a test program.
#pragma once

#include "techniques/gl/context.h"

#include <filesystem>

namespace shadowbench {

/// Made on first use; debug output on, so that a GL error is a test failure. The machine code of shaders is shared by all
/// test programs: the same techniques are made hundreds of times.
inline gl::Context& testContext() {
    static const auto context = gl::Context::create(
        {.debug = true, .shaderCache = (std::filesystem::temp_directory_path() / "shadowbench-test-shaders").string()});
    return *context;
}

} // namespace shadowbench
