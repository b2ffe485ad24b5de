// The full-screen pass that turns a technique's light-space data into visibility.
#pragma once

#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <initializer_list>

namespace shadowbench::techniques {

/// Runs the pass into these textures, in order of the shader's outputs.
inline void resolveInto(std::initializer_list<const gl::Texture*> outputs, const gl::Program& program) {
    const gl::RenderTarget target(outputs);
    target.bind();
    program.drawScreen();
}

} // namespace shadowbench::techniques
