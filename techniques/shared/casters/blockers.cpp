#include "techniques/shared/casters/blockers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace shadowbench::techniques {
namespace {

constexpr double mostSunk = 0.1;

/// A bounding box where it stands.
struct Box {
    std::array<glm::dvec3, 8> corners;
    std::array<glm::dvec4, 6> sides; // dot(side, (p, 1)) > 0 before the side, outside the box
};

Box boxOf(const Bounds& bounds, const glm::dmat4& world) {
    Box box{};
    const auto corners = bounds.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) box.corners[i] = glm::dvec3(world * glm::dvec4(corners[i], 1));
    const glm::dmat4 planes = glm::transpose(glm::inverse(world));
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 low(0, 0, 0, bounds.low[axis]), high(0, 0, 0, -bounds.high[axis]);
        low[axis] = -1;
        high[axis] = 1;
        const auto pair = static_cast<std::size_t>(axis);
        box.sides[2 * pair] = planes * low;
        box.sides[2 * pair + 1] = planes * high;
    }
    return box;
}

std::array<glm::dvec3, 4> cornersOf(const Light& light) {
    return {light.centre - 0.5 * light.u - 0.5 * light.v, light.centre + 0.5 * light.u - 0.5 * light.v,
            light.centre - 0.5 * light.u + 0.5 * light.v, light.centre + 0.5 * light.u + 0.5 * light.v};
}

bool isBefore(const glm::dvec4& side, const std::array<glm::dvec3, 8>& corners) {
    double low = 1e300, high = -1e300;
    for (const glm::dvec3& corner : corners) {
        const double before = glm::dot(side, glm::dvec4(corner, 1));
        low = std::min(low, before);
        high = std::max(high, before);
    }
    return low >= -mostSunk * (high - low);
}

/// The sides of the box that have all of the light before them.
std::vector<glm::dvec4> litSides(const Box& box, const Light& light) {
    std::vector<glm::dvec4> lit;
    const auto corners = cornersOf(light);
    for (const glm::dvec4& side : box.sides)
        if (std::ranges::all_of(corners, [&](const glm::dvec3& p) { return glm::dot(side, glm::dvec4(p, 1)) >= 0; }))
            lit.push_back(side);
    return lit;
}

} // namespace

std::vector<bool> blockers(const Snapshot& snapshot) {
    std::vector<Box> boxes;
    for (const Batch& batch : snapshot.batches) {
        const Bounds bounds = batch.mesh->bounds();
        for (const Placement& placement : batch.placements) boxes.push_back(boxOf(bounds, placement.world));
    }
    std::vector<bool> result;
    for (const Box& blocker : boxes) {
        const std::vector<glm::dvec4> lit = litSides(blocker, snapshot.light);
        result.push_back(std::ranges::any_of(boxes, [&](const Box& other) {
            return &other != &blocker &&
                   std::ranges::none_of(lit, [&](const glm::dvec4& side) { return isBefore(side, other.corners); });
        }));
    }
    return result;
}

} // namespace shadowbench::techniques
