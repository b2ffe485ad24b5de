// From GLSL to SPIR-V, by glslang.
#pragma once

#include "gpu/pipeline.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shadowbench::gpu {

/// A module for each shader, in order. What GLSL for OpenGL leaves open is chosen: loose uniforms become a block, bindings
/// and locations are numbered, those between stages by name. Throws BadInput with the compiler's first error: file and line.
std::vector<std::vector<std::uint32_t>> toSpirv(const std::vector<Shader>& shaders);

/// GLSL for OpenGL after the preprocessor, with #version and #extension. Throws BadInput with its first error.
std::string preprocessed(const Shader& shader);

/// "glslang 12.0.0".
std::string spirvCompiler();

} // namespace shadowbench::gpu
