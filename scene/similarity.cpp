#include "scene/similarity.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench {

bool scalesEvenly(const glm::dmat3& axes) {
    constexpr double kRounding = 1e-6; // of sines and scales: that of 32-bit floats, and room
    const double scale = glm::length(axes[0]);
    for (int i = 0; i < 3; ++i)
        if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kRounding * scale * scale ||
            std::abs(glm::length(axes[i]) - scale) > kRounding * scale)
            return false;
    return true;
}

} // namespace shadowbench
