// Several depth maps in one texture: for techniques that share a number of texels among the parts of a scene.
#pragma once

#include "techniques/contract/technique.h"
#include "techniques/gl/program.h"
#include "techniques/gl/texture.h"
#include "techniques/shared/light_views/light_view.h"
#include "techniques/shared/maps/depth_map.h"

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace shadowbench::techniques {

/// A rectangle of an atlas, in texels.
struct Tile {
    glm::ivec2 at, size;
    friend bool operator==(const Tile&, const Tile&) = default;
};

/// `count` square tiles that together have at most side² texels.
std::vector<Tile> squareTiles(int side, int count);

/// Of an atlas that holds the tiles, in texels.
glm::ivec2 sizeOf(const std::vector<Tile>& tiles);

// What shared/maps/depth_atlas.glsl reads of a tile of an atlas of `size` texels.
glm::mat4 atlasFromWorld(const LightView& view, const Tile& tile, glm::ivec2 size);
glm::vec4 innerTile(const Tile& tile, glm::ivec2 size); // its outermost texel centres, low and high, in [0, 1] of the atlas

class DepthAtlas {
public:
    DepthAtlas(std::vector<Tile> tiles, Bias bias);

    /// A square of `side` texels whose tiles are chosen before each drawing (`setTiles`).
    DepthAtlas(int side, Bias bias);

    /// The tiles that the next drawing fills; all lie within the atlas.
    void setTiles(std::vector<Tile> tiles);

    /// Draws one view of the scene into each tile, `views[i]` into tile i.
    void draw(const std::vector<LightView>& views, const Frame& frame);

    /// The same, of the placements `casters[i]` only (`castersIn`).
    void draw(const std::vector<LightView>& views, const Frame& frame, const std::vector<std::vector<bool>>& casters);

    /// Clears the atlas and calls `drawTile` once for each tile, with drawing confined to that tile.
    void drawTiles(const Frame& frame, const std::function<void(std::size_t)>& drawTile) const;

    /// Sets the uniforms of shared/maps/depth_atlas.glsl for the views drawn last; TILES must be the number of tiles, or
    /// more.
    void bindTo(gl::Program& program) const;

    /// Where `world` lies in tile `tile` as drawn last, in texels of the atlas; nothing beside the tile or behind the light.
    [[nodiscard]] std::optional<glm::dvec2> pointAt(std::size_t tile, const glm::dvec3& world) const;

    [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
    [[nodiscard]] const gl::Texture& texture() const { return depth_; }

private:
    DepthAtlas(glm::ivec2 size, Bias bias);
    void placeViews(const std::vector<LightView>& views);

    std::vector<Tile> tiles_;
    gl::Texture depth_;
    gl::RenderTarget target_;
    gl::Program program_;
    Bias bias_;
    std::vector<LightView> views_; // drawn last
    std::vector<glm::mat4> atlasFromWorld_;
    std::vector<glm::vec4> inner_; // per tile
};

} // namespace shadowbench::techniques
