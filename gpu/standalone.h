// Shaders that no program of ours draws with: pipelines around them.
#pragma once

#include "gpu/pipeline.h"

#include <vector>

namespace shadowbench::gpu {

/// The pipeline of a compute shader, of a vertex shader, of a fragment shader, or of the latter two together. Attributes
/// have the types that the vertex shader reads, from one buffer; targets of floats are RGBA16F, of integers RGBA32I or
/// RGBA32UI. Beside a shader alone stands another one, without a name, that copies attributes to all that a fragment shader
/// reads, or reads all that a vertex shader writes: else the compiler would take that for constants, or leave it out. Throws
/// BadInput for shaders that make no pipeline or do not compile.
Pipeline pipelineOf(std::vector<Shader> shaders);

} // namespace shadowbench::gpu
