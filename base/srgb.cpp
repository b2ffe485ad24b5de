#include "base/srgb.h"

#include <algorithm>
#include <cmath>

namespace shadowbench {

float linearFromSrgb(float e) {
    if (e < 0 || e > 1) return e;
    return e <= 0.04045F ? e / 12.92F : std::pow((e + 0.055F) / 1.055F, 2.4F);
}

float srgbFromLinear(float v) {
    if (v < 0 || v > 1) return v;
    return v <= 0.0031308F ? v * 12.92F : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
}

glm::vec3 forScreen(const glm::vec3& linear) {
    glm::vec3 shown;
    for (int i = 0; i < 3; ++i) shown[i] = srgbFromLinear(std::clamp(linear[i], 0.0F, 1.0F));
    return shown;
}

} // namespace shadowbench
