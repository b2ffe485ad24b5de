// A page of a shadow map that is drawn in pages (no GL).
#pragma once

#include <compare>
#include <glm/vec2.hpp>

namespace shadowbench::techniques {

/// A square of a light's image plane: column and row among the squares of its level. How large those of a level are is the
/// technique's to say.
struct Page {
    int plane = 0;
    int level = 0;
    glm::ivec2 at{0};
    friend bool operator==(const Page&, const Page&) = default;

    /// The order of planes, levels, rows, columns.
    friend std::strong_ordering operator<=>(const Page& a, const Page& b) {
        if (const auto order = a.plane <=> b.plane; order != 0) return order;
        if (const auto order = a.level <=> b.level; order != 0) return order;
        if (const auto order = a.at.y <=> b.at.y; order != 0) return order;
        return a.at.x <=> b.at.x;
    }
};

} // namespace shadowbench::techniques
