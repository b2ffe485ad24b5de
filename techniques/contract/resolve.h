// The full-screen pass that turns a technique's light-space data into visibility.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"

#include <initializer_list>
#include <string_view>

namespace shadowbench::techniques {

/// Runs `program` on every pixel of `outputs`, which are in the order of the shader's own, as a pass named `name`.
void resolve(const Frame& frame, std::initializer_list<const gl::Texture*> outputs, const gl::Program& program,
             std::string_view name = "resolve");

/// What a full-screen pass over the frame's pixels writes, a number a pixel.
Image<float> numbersOf(const Frame& frame, const gl::Program& program);

/// From clip space to pixels of an image of this size.
glm::dmat4 imageFromClip(glm::ivec2 size);

} // namespace shadowbench::techniques
