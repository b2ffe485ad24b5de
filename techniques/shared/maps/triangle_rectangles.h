// Triangles that a vertex shader reads itself (gl/triangles.glsl), each as six vertices: a rectangle around it, for maps
// whose fragment shaders test triangles.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"

namespace shadowbench::techniques {

/// Draws every placement of the frame into the bound target. The program has the uniform baseInstance; its vertices 6 i to
/// 6 i + 5 are of triangle i.
void drawTriangleRectangles(const Frame& frame, gl::Program& program);

} // namespace shadowbench::techniques
