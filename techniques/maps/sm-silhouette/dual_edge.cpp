#include "techniques/maps/sm-silhouette/dual_edge.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {

std::optional<DualEdge> onDualGrid(const LightView& view, glm::dvec3 a, glm::dvec3 b, int side) {
    if (view.perspective) {
        const glm::dvec4 plane = view.depthFromWorld - glm::dvec4(0, 0, 0, 1e-4 * view.far); // as casters are cut
        const double da = glm::dot(plane, glm::dvec4(a, 1)), db = glm::dot(plane, glm::dvec4(b, 1));
        if (da <= 0 && db <= 0) return std::nullopt;
        const glm::dvec3 crossing = a + da / (da - db) * (b - a);
        if (da <= 0) a = crossing;
        if (db <= 0) b = crossing;
    }
    const auto dual = [&](const glm::dvec3& p) {
        const glm::dvec4 h = view.clipFromWorld * glm::dvec4(p, 1);
        const glm::dvec3 map = 0.5 * glm::dvec3(h) / h.w + 0.5;
        return glm::vec3(map.x * side + 0.5, map.y * side + 0.5, map.z);
    };
    return DualEdge{dual(a), dual(b)};
}

} // namespace shadowbench::techniques
