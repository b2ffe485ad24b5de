// Tiles of a light's image planes and their maps: what techniques share that choose the tiles by what the camera sees.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/gl/program.h"
#include "techniques/gl/scene_buffers.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/tile_choice.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shadowbench::techniques {

class TilesOnPlanes {
public:
    /// On planes cut into `cells`² cells.
    explicit TilesOnPlanes(int cells) : cells_(cells) {}

    void set(std::vector<PlaneTile> tiles, std::size_t planes);

    /// Makes shared/maps/tile_of_pixel.glsl find these tiles.
    void bindTo(gl::Program& program) const;

    [[nodiscard]] const std::vector<PlaneTile>& tiles() const { return tiles_; }

    /// The view of a tile's map.
    [[nodiscard]] LightView viewOf(const PlaneTile& tile, const std::vector<LightView>& planes) const;

    /// Texels per side of a map of a whole plane whose texels are as short as the shortest of a tile.
    [[nodiscard]] double effectiveResolution() const;

    /// Where `world` lies in its tile, in texels of what holds the tile; nothing where no tile holds it.
    [[nodiscard]] std::optional<glm::dvec2> pointAt(const std::vector<LightView>& planes, const glm::dvec3& world) const;

private:
    int cells_;
    std::vector<PlaneTile> tiles_;
    std::vector<std::uint32_t> table_; // tileTable() of them
    gl::Buffer tableBuffer_;
};

/// What the figure `effective_resolution` of these techniques means.
inline Figure effectiveResolutionFigure() {
    return {"effective_resolution",
            "texels per side of a map of the light's whole plane with texels as short as the shortest"};
}

} // namespace shadowbench::techniques
