// What denoisers of a ray a pixel know beside the rays: the surfaces that pixels see (techniques/modern/surface.glsl), and
// where the frame before had them.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"

namespace shadowbench::techniques {

void bindSurfaces(const Frame& frame, gl::Program& program);

/// What the frame before saw of each pixel's point. `mean` and `moments` hold nothing yet where that frame is not `known`.
void bindHistory(const Frame& frame, gl::Program& program, const gl::Texture& mean, const gl::Texture& moments, bool known);

} // namespace shadowbench::techniques
