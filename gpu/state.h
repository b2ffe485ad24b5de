// What OpenGL's context says of the draw that comes next.
#pragma once

#include "gpu/pipeline.h"

#include <vector>

namespace shadowbench::gpu {

/// The shaders of the program in use, as they were given to OpenGL, by their labels.
std::vector<Shader> currentShaders();

/// The state of a draw of `topology`.
State drawState(unsigned topology);

} // namespace shadowbench::gpu
