#include "techniques/shared/light_views/fitting.h"

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {

glm::dvec3 divided(const glm::dvec4& h) { return glm::dvec3(h) / h.w; }

std::vector<glm::dvec3> cut(const std::vector<glm::dvec3>& polygon, const glm::dvec4& plane,
                            std::vector<glm::dvec3>* cutPoints) {
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(plane, glm::dvec4(a, 1));
        const double db = glm::dot(plane, glm::dvec4(b, 1));
        if (da >= 0) kept.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        kept.push_back(a + da / (da - db) * (b - a));
        if (cutPoints != nullptr) cutPoints->push_back(kept.back());
    }
    return kept;
}

Bounds boundsOf(const glm::dmat4& transform, const std::vector<glm::dvec3>& points) {
    Bounds box;
    for (const glm::dvec3& p : points) box.add(divided(transform * glm::dvec4(p, 1)));
    return box;
}

glm::dmat4 fitMatrix(const Bounds& box, double margin) {
    const glm::dvec3 size = glm::max(box.high - box.low, glm::dvec3(1e-12));
    const glm::dvec3 room(1 - 2 * margin, 1 - 2 * margin, 1);
    const glm::dmat4 scaled = glm::scale(glm::dmat4(1), 2.0 * room / size);
    return glm::translate(scaled, -0.5 * (box.low + box.high));
}

} // namespace shadowbench::techniques
