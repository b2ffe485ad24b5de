#include "techniques/shared/maps/tile_choice.h"

#include <algorithm>
#include <cstddef>

namespace shadowbench::techniques {

std::vector<std::uint32_t> tileTable(std::span<const PlaneTile> tiles, int planes, int cells) {
    const auto side = static_cast<std::size_t>(cells);
    std::vector<std::uint32_t> table(static_cast<std::size_t>(planes) * side * side, 0);
    std::uint32_t number = 0;
    for (const PlaneTile& tile : tiles) {
        ++number;
        for (int row = 0; row < tile.size.y; ++row) {
            const std::size_t line = static_cast<std::size_t>(tile.plane) * side + static_cast<std::size_t>(tile.at.y + row);
            std::fill_n(table.begin() + static_cast<std::ptrdiff_t>(line * side) + tile.at.x, tile.size.x, number);
        }
    }
    return table;
}

} // namespace shadowbench::techniques
