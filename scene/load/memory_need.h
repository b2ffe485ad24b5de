// The least memory that a scene takes, so that one that cannot fit is refused before the work.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace shadowbench {

std::uint64_t bytesOf(const Mesh& mesh);

/// Bytes that any work on the scene takes at least: its meshes in memory and on the graphics device, its instances'
/// triangles in the world at their coarsest levels, as every truth holds them, and its image with what is drawn and scored
/// at a pixel.
std::uint64_t leastMemory(const Scene& scene);

} // namespace shadowbench
