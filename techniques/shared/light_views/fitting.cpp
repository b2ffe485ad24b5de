#include "techniques/shared/light_views/fitting.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {

void Extent::add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
}

glm::dvec3 divided(const glm::dvec4& h) { return glm::dvec3(h) / h.w; }

Extent extentOf(const glm::dmat4& transform, const std::vector<glm::dvec3>& points) {
    Extent extent;
    for (const glm::dvec3& p : points) extent.add(divided(transform * glm::dvec4(p, 1)));
    return extent;
}

glm::dmat4 fitMatrix(const Extent& extent, double margin) {
    const glm::dvec3 size = glm::max(extent.high - extent.low, glm::dvec3(1e-12));
    const glm::dvec3 room(1 - 2 * margin, 1 - 2 * margin, 1);
    const glm::dmat4 scaled = glm::scale(glm::dmat4(1), 2.0 * room / size);
    return glm::translate(scaled, -0.5 * (extent.low + extent.high));
}

} // namespace shadowbench::techniques
