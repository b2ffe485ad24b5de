#include "techniques/shared/maps/min_max_pyramid.h"

#include "techniques/gl/api.h"

#include <bit>
#include <cstddef>

namespace shadowbench::techniques {
namespace {

int roundedUp(int side) { return static_cast<int>(std::bit_ceil(static_cast<unsigned>(side))); }

/// Where level `number` of layer `layer` begins in the atlas: level 1 at the left, the others in a column beside it, as
/// nodeRange() of shared/maps/min_max_pyramid.glsl reads them.
glm::ivec2 placeOf(int side, int layer, int number) {
    const int across = side / 2;
    const glm::ivec2 place = number > 1 ? glm::ivec2(across, across - (side >> (number - 1))) : glm::ivec2(0);
    return place + glm::ivec2(0, layer * across);
}

} // namespace

MinMaxPyramid::MinMaxPyramid(int side, NodeEnds ends, int layers)
    : mapSide_(side), side_(roundedUp(side)), layers_(layers),
      atlas_(gl::Format::RG32F, {side_ / 2 + side_ / 4, layers * side_ / 2}),
      first_(gl::Program::screen("shared/maps/min_max_first.frag", {{"ACROSS", ends == NodeEnds::Shared ? "3" : "2"}})),
      next_(gl::Program::screen("shared/maps/min_max_next.frag")) {
    for (int size = side_ / 2; size > 0; size /= 2) levels_.emplace_back(gl::Format::RG32F, glm::ivec2(size));
}

void MinMaxPyramid::draw(const gl::Texture& depths, const Frame& frame) {
    const auto pass = frame.pass("min/max pyramid");
    for (int layer = 0; layer < layers_; ++layer) drawLayer(depths, layer);
}

void MinMaxPyramid::drawLayer(const gl::Texture& depths, int layer) {
    glm::vec4 channel(0);
    channel[layer] = 1;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
        gl::Program& program = i == 0 ? first_ : next_;
        if (i == 0)
            first_.set("depths", depths).set("channel", channel);
        else
            next_.set("finer", levels_[i - 1]);
        const gl::RenderTarget target({&levels_[i]});
        target.bind();
        program.drawScreen();
        const glm::ivec2 size = levels_[i].size();
        const glm::ivec2 place = placeOf(side_, layer, static_cast<int>(i) + 1);
        glCopyImageSubData(levels_[i].id(), GL_TEXTURE_2D, 0, 0, 0, 0, atlas_.id(), GL_TEXTURE_2D, 0, place.x, place.y, 0,
                           size.x, size.y, 1);
    }
}

void MinMaxPyramid::bindTo(gl::Program& program) const {
    program.set("pyramid", atlas_).set("pyramidSide", side_).set("mapSide", mapSide_);
}

} // namespace shadowbench::techniques
