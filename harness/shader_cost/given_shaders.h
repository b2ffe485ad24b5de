// Shaders that a user names by their files.
#pragma once

#include "gpu/pipeline.h"

#include <string>
#include <vector>

namespace shadowbench::shaders {

/// GLSL in FILE.vert, .frag or .comp, SPIR-V in FILE.spv. Files that differ in the ending of their stage alone (blur.vert,
/// blur.frag; blur.vert.spv, blur.frag.spv) are one program. Throws BadInput naming a file of another ending, one that is
/// not there or is no SPIR-V.
std::vector<std::vector<gpu::Shader>> programsOf(const std::vector<std::string>& files);

} // namespace shadowbench::shaders
