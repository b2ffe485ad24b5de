#include "scene/meshes/scatter.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench {
namespace {

struct Cell {
    glm::dvec3 at;
    std::uint64_t number;
};

/// The free cells of a grid of about `wanted` square cells.
std::vector<Cell> freeCells(const Scatter& s, double wanted) {
    const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(wanted * s.half.x / s.half.y))));
    const int rows = std::max(1, static_cast<int>(std::ceil(wanted / columns)));
    const glm::dvec2 pitch = 2.0 * s.half / glm::dvec2(columns, rows);
    std::vector<Cell> cells;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::uint64_t number =
                static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(columns) + static_cast<std::uint64_t>(column);
            Random random((static_cast<std::uint64_t>(s.seed) << 32U) ^ number);
            const double x = column + 0.5 + s.jitter * random.uniform(-0.5, 0.5);
            const double z = row + 0.5 + s.jitter * random.uniform(-0.5, 0.5);
            const glm::dvec3 at = s.centre + glm::dvec3(x * pitch.x - s.half.x, 0, z * pitch.y - s.half.y);
            if (glm::distance(glm::dvec2(at.x, at.z), s.keepOff) >= s.clear) cells.push_back({at, number});
        }
    }
    return cells;
}

/// Leaves out as many cells as are too many, the ones that the seed picks.
void thin(std::vector<Cell>& cells, std::size_t count, std::uint32_t seed) {
    const auto rank = [seed](const Cell& cell) {
        return mixBits(~((static_cast<std::uint64_t>(seed) << 32U) ^ cell.number));
    };
    std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) { return rank(a) < rank(b); });
    cells.resize(count);
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.number < b.number; });
}

} // namespace

std::vector<glm::dmat4> scattered(const Scatter& s) {
    const auto count = static_cast<std::size_t>(s.count);
    constexpr double kMostRefined = 1000; // a field that is all kept free would never have room
    std::vector<Cell> cells = freeCells(s, s.count);
    for (double factor = 1.03; cells.size() < count && factor < kMostRefined; factor *= 1.03)
        cells = freeCells(s, factor * s.count);
    if (cells.size() < count) return {};
    thin(cells, count, s.seed);

    std::vector<glm::dmat4> places;
    for (const Cell& cell : cells) {
        Random random(mixBits((static_cast<std::uint64_t>(s.seed) << 32U) ^ cell.number));
        const double turn = random.uniform(s.turn.x, s.turn.y);
        places.push_back(placed(cell.at, turn, random.uniform(s.scale.x, s.scale.y)));
    }
    return places;
}

glm::dmat4 placed(const glm::dvec3& at, double turn, double scale) {
    glm::dmat4 place = glm::translate(glm::dmat4(1), at);
    if (turn != 0) place = glm::rotate(place, glm::radians(turn), glm::dvec3(0, 1, 0));
    return glm::scale(place, glm::dvec3(scale));
}

} // namespace shadowbench
