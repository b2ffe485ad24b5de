#include "techniques/maps/tiled_planes.h"

#include "techniques/maps/fitting.h"
#include "techniques/resolve.h"

#include <cstdint>
#include <glm/common.hpp>

namespace shadowbench::techniques {
namespace {

gl::Defines demandDefines(const TiledPlanes::Discontinuity& discontinuity) {
    if (!discontinuity) return {};
    return {{"DISCONTINUITY", "1"}, {"TILES", "6"}};
}

/// How a tile's part of its plane lies in the atlas, as maps/tile_test.frag reads it.
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
      demand_(gl::Program::screen("maps/demand.frag", demandDefines(discontinuity))),
      test_(gl::Program::screen("maps/tile_test.frag")) {
    demand_.set("most", most);
    if (discontinuity) demand_.set("discontinuity", *discontinuity);
    test_.set("cells", cells);
}

void TiledPlanes::fit(const Frame& frame) {
    planes_ = lightPlanes(frame.snapshot.light, frame.snapshot);
    corners_ = boundingCorners(frame.snapshot);
    std::vector<glm::mat4> planeFromWorld;
    for (const LightView& plane : planes_) planeFromWorld.push_back(mapFromWorld(plane));
    for (gl::Program* program : {&demand_, &test_}) program->set("planeFromWorld", planeFromWorld);
}

void TiledPlanes::drawWholePlanes(const Frame& frame) {
    atlas_.setTiles(squareTiles(side_, static_cast<int>(planes_.size())));
    atlas_.draw(planes_, frame.scene);
    atlas_.bindTo(demand_);
}

std::vector<Demand> TiledPlanes::demands(const Frame& frame, const gl::Texture& visibility) {
    fit(frame);
    if (discontinuity_) drawWholePlanes(frame);
    if (!demands_ || demands_->size() != frame.size) demands_.emplace(gl::Format::RGBA32F, frame.size);
    demand_.set("planes", static_cast<int>(planes_.size()))
        .set("light", glm::vec4(frame.snapshot.light.centreOnly().homogeneous()))
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

void TiledPlanes::shade(const Frame& frame, std::span<const PlaneTile> tiles, const gl::Texture& visibility) {
    std::vector<Tile> rectangles;
    std::vector<LightView> views;
    std::vector<std::vector<bool>> casters;
    std::vector<Place> places;
    for (const PlaneTile& tile : tiles) {
        const glm::dvec2 low = glm::dvec2(tile.at) / static_cast<double>(cells_);
        const glm::dvec2 high = glm::dvec2(tile.at + tile.size) / static_cast<double>(cells_);
        rectangles.push_back(tile.texels);
        views.push_back(partOf(planes_[static_cast<std::size_t>(tile.plane)], low, high));
        casters.push_back(castersIn(views.back(), corners_));
        places.push_back(placeOf(tile, cells_, side_));
    }
    atlas_.setTiles(std::move(rectangles));
    atlas_.draw(views, frame.scene, casters);

    const std::vector<std::uint32_t> table = tileTable(tiles, static_cast<int>(planes_.size()), cells_);
    table_.upload(table.data(), table.size() * sizeof(std::uint32_t));
    places_.upload(places.data(), places.size() * sizeof(Place));
    table_.bindStorage(3); // maps/tile_test.frag
    places_.bindStorage(4);
    test_.set("positions", frame.gbuffer.position()).set("demands", *demands_).set("depthAtlas", atlas_.texture());
    resolveInto({&visibility}, test_);
}

std::optional<TiledPlanes::Spot> TiledPlanes::spotOf(const glm::dvec3& world) const {
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
        const glm::dvec4 h = mapFromClip() * planes_[plane].clipFromWorld * glm::dvec4(world, 1);
        if (h.w <= 0) continue;
        const glm::dvec2 at = glm::dvec2(h) / h.w;
        if (glm::clamp(at, 0.0, 1.0) == at) return Spot{static_cast<int>(plane), at};
    }
    return std::nullopt;
}

} // namespace shadowbench::techniques
