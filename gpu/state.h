// What OpenGL's context says of the draw that comes next.
#pragma once

#include "gpu/pipeline.h"

#include <utility>
#include <vector>

namespace shadowbench::gpu {

/// The shaders of the program in use, as they were given to OpenGL, by their labels.
std::vector<Shader> currentShaders();

/// The state of a draw of `topology`.
State drawState(unsigned topology);

/// A texture, or what is attached to a framebuffer.
struct Target {
    unsigned format = 0; // OpenGL's; 0: nothing is there
    int width = 0, height = 0;
};

/// Of the framebuffer that is drawn into, what a clear of `buffer` (GL_COLOR, GL_DEPTH, GL_STENCIL) clears.
Target clearedBy(unsigned buffer, int drawBuffer);

Target textureTarget(unsigned texture);

/// The pixels that draws reach: the size of the viewport.
std::pair<int, int> viewport();

} // namespace shadowbench::gpu
