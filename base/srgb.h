// The transfer of sRGB, as pictures for screens are kept (IEC 61966-2-1). Values outside [0, 1] stay.
#pragma once

#include <glm/vec3.hpp>

namespace shadowbench {

float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

/// What a screen shows of linear light, each colour clamped to [0, 1].
glm::vec3 forScreen(const glm::vec3& linear);

} // namespace shadowbench
