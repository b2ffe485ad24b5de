// A box in the coordinates of a receiver's plane: the scene's Bounds with one axis fewer.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace shadowbench::groundtruth::plan {

/// Empty until the first point is added.
struct PlaneBox {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    [[nodiscard]] glm::dvec2 size() const { return high - low; }
    [[nodiscard]] bool contains(const glm::dvec2& p) const {
        return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
    }
};

} // namespace shadowbench::groundtruth::plan
