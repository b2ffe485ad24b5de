// What pixels ask of the maps over a light's image planes, and the tiles that answer (no GL).
#pragma once

#include "techniques/shared/maps/depth_atlas.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace shadowbench::techniques {

/// What one pixel asks: a texel should be no larger than the pixel where the pixel's surface point lies.
struct Demand {
    int plane;        // of `lightPlanes`
    glm::vec2 at;     // in [0, 1)² of that plane's map
    glm::vec2 pixels; // image pixels that the map's whole width and height are long here: 1 / n of it is a texel of n
};

/// A rectangle of a plane, in cells of a square grid over it, and the rectangle of an atlas that holds its map.
struct PlaneTile {
    int plane = 0;
    glm::ivec2 at{0}, size{0}; // cells
    Tile texels{};
    friend bool operator==(const PlaneTile&, const PlaneTile&) = default;
};

/// The cell of `at` on a grid of `cells` per side.
inline glm::ivec2 cellOf(glm::vec2 at, int cells) { return glm::ivec2(at * static_cast<float>(cells)); }

/// For each cell of `planes` grids, row by row: 0, or 1 + the number of the tile that holds it.
std::vector<std::uint32_t> tileTable(std::span<const PlaneTile> tiles, int planes, int cells);

} // namespace shadowbench::techniques
