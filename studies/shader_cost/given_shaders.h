// Shaders that a user names by their files.
#pragma once

#include "gpu/pipeline.h"

#include <string>
#include <vector>

namespace shadowbench::shaders {

/// GLSL in files that end in .vert, .frag or .comp, SPIR-V in those that end in .spv. A vertex and a fragment shader whose
/// names differ in that ending alone, before a .spv, are one program. Throws BadInput naming a file of another ending, one
/// that is not there or is no SPIR-V.
std::vector<std::vector<gpu::Shader>> programsOf(const std::vector<std::string>& files);

} // namespace shadowbench::shaders
