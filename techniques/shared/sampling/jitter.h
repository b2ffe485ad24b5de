// Jittered taps (Zápotocký 3.4): a regular grid of cells, one tap at random in each, the grid warped to a disk.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace shadowbench::techniques {

/// How the disk is cut into cells of equal area: `rings` around its middle, each into `sectors`.
struct JitterGrid {
    int sectors, rings;

    [[nodiscard]] int taps() const { return sectors * rings; }
};

/// Eq. 3.1–3.2: where (u, v) of the unit square comes to lie in the unit disk, areas in proportion.
glm::dvec2 warpedToDisk(double u, double v);

/// One tap in each cell, the outermost ring first, by ascending sector within a ring. Sets of different numbers are
/// independent of each other; a set is the same on every machine.
std::vector<glm::vec2> jitteredTaps(const JitterGrid& grid, std::uint32_t set);

} // namespace shadowbench::techniques
