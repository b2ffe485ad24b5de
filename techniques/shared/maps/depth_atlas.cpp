#include "techniques/shared/maps/depth_atlas.h"

#include "techniques/gl/api.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {

glm::ivec2 sizeOf(const std::vector<Tile>& tiles) {
    glm::ivec2 size(0);
    for (const Tile& tile : tiles) size = glm::max(size, tile.at + tile.size);
    return size;
}

glm::mat4 atlasFromWorld(const LightView& view, const Tile& tile, glm::ivec2 size) {
    const glm::dvec2 share = glm::dvec2(tile.size) / glm::dvec2(size), offset = glm::dvec2(tile.at) / glm::dvec2(size);
    const glm::dmat4 place =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(offset, 0)), glm::dvec3(share, 1)) * mapFromClip();
    return glm::mat4(place * view.clipFromWorld);
}

glm::vec4 innerTile(const Tile& tile, glm::ivec2 size) {
    const glm::vec2 low(tile.at), high(tile.at + tile.size);
    return glm::vec4(low + 0.5F, high - 0.5F) / glm::vec4(size, size);
}

std::vector<Tile> squareTiles(int side, int count) {
    const int each = static_cast<int>(side / std::sqrt(count));
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    std::vector<Tile> tiles;
    for (int i = 0; i < count; ++i) tiles.push_back({each * glm::ivec2(i % columns, i / columns), {each, each}});
    return tiles;
}

DepthAtlas::DepthAtlas(glm::ivec2 size, Bias bias)
    : depth_(gl::Format::Depth32F, size, gl::Filter::Nearest, gl::Wrap::BorderFar), target_{&depth_},
      program_("shared/maps/depth_map.vert", "gl/depth_only.frag"), bias_(bias) {
    depth_.compareDepth();
}

DepthAtlas::DepthAtlas(std::vector<Tile> tiles, Bias bias) : DepthAtlas(sizeOf(tiles), bias) { setTiles(std::move(tiles)); }

DepthAtlas::DepthAtlas(int side, Bias bias) : DepthAtlas(glm::ivec2(side), bias) {}

void DepthAtlas::setTiles(std::vector<Tile> tiles) {
    tiles_ = std::move(tiles);
    inner_.clear();
    for (const Tile& tile : tiles_) inner_.push_back(innerTile(tile, depth_.size()));
}

void DepthAtlas::drawTiles(const Frame& frame, const std::function<void(std::size_t)>& drawTile) const {
    const auto pass = frame.pass("depth map");
    target_.clearDepth(1);
    glEnable(GL_SCISSOR_TEST);
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        const Tile& tile = tiles_[i];
        target_.bind();
        glViewport(tile.at.x, tile.at.y, tile.size.x, tile.size.y);
        glScissor(tile.at.x, tile.at.y, tile.size.x, tile.size.y);
        drawTile(i);
    }
    glDisable(GL_SCISSOR_TEST);
}

void DepthAtlas::draw(const std::vector<LightView>& views, const Frame& frame) {
    drawTiles(frame, [&](std::size_t i) {
        const CasterPass tile(program_, views[i], bias_);
        frame.scene.draw();
    });
    placeViews(views);
}

void DepthAtlas::draw(const std::vector<LightView>& views, const Frame& frame,
                      const std::vector<std::vector<bool>>& casters) {
    drawTiles(frame, [&](std::size_t i) {
        const CasterPass tile(program_, views[i], bias_);
        frame.scene.draw(casters[i]);
    });
    placeViews(views);
}

void DepthAtlas::placeViews(const std::vector<LightView>& views) {
    views_ = views;
    atlasFromWorld_.clear();
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        atlasFromWorld_.push_back(techniques::atlasFromWorld(views[i], tiles_[i], depth_.size()));
}

std::optional<glm::dvec2> DepthAtlas::pointAt(std::size_t tile, const glm::dvec3& world) const {
    std::optional<glm::dvec2> point = texelAt(views_[tile], world, tiles_[tile].size);
    if (point) *point += tiles_[tile].at;
    return point;
}

void DepthAtlas::bindTo(gl::Program& program) const {
    program.set("depthAtlas", depth_).set("atlasFromWorld", atlasFromWorld_).set("innerTiles", inner_);
}

} // namespace shadowbench::techniques
