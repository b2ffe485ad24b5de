#include "techniques/shared/maps/tiled_map.h"

#include "techniques/contract/resolve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace shadowbench::techniques {
namespace {

gl::Defines demandDefines(const TiledPlanes::Discontinuity& discontinuity) {
    if (!discontinuity) return {};
    return {{"DISCONTINUITY", "1"}, {"TILES", "6"}};
}

/// How a tile's part of its plane lies in the atlas, as shared/maps/tile_test.frag reads it.
struct Place {
    glm::vec2 offset, scale; // atlas = offset + scale · plane, both in [0, 1]
    glm::vec4 inner;         // outermost texel centres, low and high
};

Place placeOf(const PlaneTile& tile, int cells, int side) {
    const glm::dvec2 low = glm::dvec2(tile.texels.at) / static_cast<double>(side);
    const glm::dvec2 size = glm::dvec2(tile.texels.size) / static_cast<double>(side);
    const glm::dvec2 scale = size * static_cast<double>(cells) / glm::dvec2(tile.size);
    const glm::dvec2 half(0.5 / side);
    return {glm::vec2(low - scale * glm::dvec2(tile.at) / static_cast<double>(cells)), glm::vec2(scale),
            glm::vec4(low + half, low + size - half)};
}

} // namespace

TiledPlanes::TiledPlanes(int side, int cells, float most, Bias bias, Discontinuity discontinuity)
    : side_(side), cells_(cells), discontinuity_(discontinuity), atlas_(side, bias),
      demand_(gl::Program::screen("shared/maps/demand.frag", demandDefines(discontinuity))),
      test_(gl::Program::screen("shared/maps/tile_test.frag")) {
    demand_.set("most", most);
    if (discontinuity) demand_.set("discontinuity", *discontinuity);
    test_.set("cells", cells);
}

void TiledPlanes::fit(const Frame& frame) {
    planes_ = lightPlanes(frame.hardLight, frame.snapshot);
    corners_ = boundingCorners(frame.snapshot);
    std::vector<glm::mat4> planeFromWorld;
    for (const LightView& plane : planes_) planeFromWorld.push_back(mapFromWorld(plane));
    for (gl::Program* program : {&demand_, &test_}) program->set("planeFromWorld", planeFromWorld);
}

void TiledPlanes::drawWholePlanes(const Frame& frame) {
    atlas_.setTiles(squareTiles(side_, static_cast<int>(planes_.size())));
    atlas_.draw(planes_, frame);
    atlas_.bindTo(demand_);
}

std::vector<Demand> TiledPlanes::demands(const Frame& frame, const gl::Texture& visibility) {
    fit(frame);
    if (discontinuity_) drawWholePlanes(frame);
    const auto pass = frame.pass("demands");
    if (!demands_ || demands_->size() != frame.size) demands_.emplace(gl::Format::RGBA32F, frame.size);
    demand_.set("planes", static_cast<int>(planes_.size()))
        .set("light", glm::vec4(frame.hardLight.homogeneous()))
        .set("positions", frame.gbuffer.position())
        .set("normals", frame.gbuffer.normal())
        .set("clipFromWorld", glm::mat4(frame.clipFromWorld));
    const gl::RenderTarget target({&*demands_, &visibility});
    target.bind();
    demand_.drawScreen();

    std::vector<Demand> result;
    for (const glm::vec4& d : target.readVec4(0)) {
        if (d.z == 0) continue;
        const float plane = std::floor(d.x);
        result.push_back({static_cast<int>(plane), {d.x - plane, d.y}, {d.z, d.w}});
    }
    return result;
}

void TiledPlanes::shade(const Frame& frame, std::vector<PlaneTile> tiles, std::size_t together,
                        const gl::Texture& visibility) {
    tiles_ = std::move(tiles);
    upload();
    test_.set("positions", frame.gbuffer.position()).set("demands", *demands_).set("depthAtlas", atlas_.texture());
    for (std::size_t first = 0; first < tiles_.size(); first += together) {
        const std::size_t count = std::min(together, tiles_.size() - first);
        drawTiles(frame, std::span(tiles_).subspan(first, count));
        test_.set("firstTile", static_cast<int>(first)).set("tilesDrawn", static_cast<int>(count));
        resolve(frame, {&visibility}, test_);
    }
}

void TiledPlanes::upload() {
    table_ = tileTable(tiles_, static_cast<int>(planes_.size()), cells_);
    std::vector<Place> places;
    for (const PlaneTile& tile : tiles_) places.push_back(placeOf(tile, cells_, side_));
    tableBuffer_.upload(table_.data(), table_.size() * sizeof(std::uint32_t));
    placeBuffer_.upload(places.data(), places.size() * sizeof(Place));
    tableBuffer_.bindStorage(3); // shared/maps/tile_test.frag
    placeBuffer_.bindStorage(4);
}

void TiledPlanes::drawTiles(const Frame& frame, std::span<const PlaneTile> tiles) {
    std::vector<Tile> rectangles;
    std::vector<LightView> views;
    std::vector<std::vector<bool>> casters;
    for (const PlaneTile& tile : tiles) {
        const glm::dvec2 low = glm::dvec2(tile.at) / static_cast<double>(cells_);
        const glm::dvec2 high = glm::dvec2(tile.at + tile.size) / static_cast<double>(cells_);
        rectangles.push_back(tile.texels);
        views.push_back(partOf(planes_[static_cast<std::size_t>(tile.plane)], low, high));
        casters.push_back(castersIn(views.back(), corners_));
    }
    atlas_.setTiles(std::move(rectangles));
    atlas_.draw(views, frame, casters);
}

double TiledPlanes::effectiveResolution() const {
    double finest = 0;
    for (const PlaneTile& tile : tiles_) {
        const glm::dvec2 resolution = glm::dvec2(tile.texels.size * cells_) / glm::dvec2(tile.size);
        finest = std::max({finest, resolution.x, resolution.y});
    }
    return finest;
}

std::optional<glm::dvec2> TiledPlanes::pointAt(const glm::dvec3& world) const {
    const auto side = static_cast<std::size_t>(cells_);
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
        const std::optional<glm::dvec2> cell = texelAt(planes_[plane], world, glm::dvec2(cells_));
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
