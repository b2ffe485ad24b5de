// Shadow maps over tiles of a light's image planes: what techniques share that choose the tiles by what the camera sees.
#pragma once

#include "techniques/contract/entry.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/maps/depth_atlas.h"
#include "techniques/shared/maps/tile_choice.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace shadowbench::techniques {

class TiledPlanes {
public:
    /// Whether demands are weighted by the depth discontinuities of a map of the whole planes, and by how much of them (the
    /// share of a pixel's weight that it has only beside one, in [0, 1]).
    using Discontinuity = std::optional<float>;

    /// An atlas of `side`² texels, for planes cut into `cells`² cells. A pixel asks for at most `most` texels along a plane.
    TiledPlanes(int side, int cells, float most, Bias bias, Discontinuity discontinuity = {});

    /// Fits the planes to the frame and returns what its pixels ask of them, row by row. With a discontinuity share the
    /// atlas is first filled with a map of the whole planes. Pixels that ask for nothing get their visibility here: 1 where
    /// nothing is seen, 0 on surfaces that face away from the light.
    std::vector<Demand> demands(const Frame& frame, const gl::Texture& visibility);

    /// Draws the tiles and tests the pixels that lie in them: `together` at a time, which lie apart in the atlas.
    void shade(const Frame& frame, std::vector<PlaneTile> tiles, std::size_t together, const gl::Texture& visibility);

    /// Views of the planes that `demands` fitted: one, or six.
    [[nodiscard]] const std::vector<LightView>& planes() const { return planes_; }

    /// The tiles drawn last.
    [[nodiscard]] const std::vector<PlaneTile>& tiles() const { return tiles_; }

    /// Texels per side of a map of a whole plane whose texels are as short as the shortest drawn last.
    [[nodiscard]] double effectiveResolution() const;

    /// Where `world` lies in its tile, in texels of the atlas; nothing where no tile holds it.
    [[nodiscard]] std::optional<glm::dvec2> pointAt(const glm::dvec3& world) const;

private:
    void fit(const Frame& frame);
    void upload();
    void drawTiles(const Frame& frame, std::span<const PlaneTile> tiles);
    void drawWholePlanes(const Frame& frame);

    int side_, cells_;
    Discontinuity discontinuity_;
    DepthAtlas atlas_;
    gl::Program demand_, test_;
    std::optional<gl::Texture> demands_;
    gl::Buffer tableBuffer_, placeBuffer_;

    std::vector<LightView> planes_;
    std::vector<glm::dvec3> corners_; // of the placements' bounding boxes
    std::vector<PlaneTile> tiles_;
    std::vector<std::uint32_t> table_; // tileTable() of them
};

/// What the figure `effective_resolution` of these techniques means.
inline Figure effectiveResolutionFigure() {
    return {"effective_resolution",
            "texels per side of a map of the light's whole plane with texels as short as the shortest"};
}

} // namespace shadowbench::techniques
