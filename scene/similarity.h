// What a place of an instance may do to an object.
#pragma once

#include <glm/mat3x3.hpp>

namespace shadowbench {

/// Whether a map turns, mirrors and scales all directions alike, to the rounding of 32-bit floats: what places of instances
/// must, so that a spin never shears an object.
bool scalesEvenly(const glm::dmat3& axes);

} // namespace shadowbench
