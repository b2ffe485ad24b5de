// Reading back what shaders have written into a buffer.
#pragma once

#include "techniques/gl/scene_buffers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shadowbench::gl {

/// The first `count` words, which `buffer` must have. Blocks until the GPU is done.
std::vector<std::uint32_t> readWords(const Buffer& buffer, std::size_t count);

} // namespace shadowbench::gl
