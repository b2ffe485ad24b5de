#include "techniques/shared/maps/tiles_on_planes.h"

#include "techniques/shared/light_views/light_planes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace shadowbench::techniques {

void TilesOnPlanes::set(std::vector<PlaneTile> tiles, std::size_t planes) {
    tiles_ = std::move(tiles);
    table_ = tileTable(tiles_, static_cast<int>(planes), cells_);
    tableBuffer_.upload(table_.data(), table_.size() * sizeof(std::uint32_t));
}

void TilesOnPlanes::bindTo(gl::Program& program) const {
    tableBuffer_.bindStorage(3); // shared/maps/tile_of_pixel.glsl
    program.set("cells", cells_);
}

LightView TilesOnPlanes::viewOf(const PlaneTile& tile, const std::vector<LightView>& planes) const {
    const glm::dvec2 low = glm::dvec2(tile.at) / static_cast<double>(cells_);
    const glm::dvec2 high = glm::dvec2(tile.at + tile.size) / static_cast<double>(cells_);
    return partOf(planes[static_cast<std::size_t>(tile.plane)], low, high);
}

double TilesOnPlanes::effectiveResolution() const {
    double finest = 0;
    for (const PlaneTile& tile : tiles_) {
        const glm::dvec2 resolution = glm::dvec2(tile.texels.size * cells_) / glm::dvec2(tile.size);
        finest = std::max({finest, resolution.x, resolution.y});
    }
    return finest;
}

std::optional<glm::dvec2> TilesOnPlanes::pointAt(const std::vector<LightView>& planes, const glm::dvec3& world) const {
    const auto side = static_cast<std::size_t>(cells_);
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        const std::optional<glm::dvec2> cell = texelAt(planes[plane], world, glm::dvec2(cells_));
        if (!cell) continue;
        const glm::ivec2 whole = glm::min(glm::ivec2(*cell), cells_ - 1);
        const std::uint32_t number =
            table_[(plane * side + static_cast<std::size_t>(whole.y)) * side + static_cast<std::size_t>(whole.x)];
        if (number == 0) return std::nullopt;
        const PlaneTile& tile = tiles_[number - 1];
        return glm::dvec2(tile.texels.at) +
               (*cell - glm::dvec2(tile.at)) * glm::dvec2(tile.texels.size) / glm::dvec2(tile.size);
    }
    return std::nullopt;
}

} // namespace shadowbench::techniques
