#include "techniques/shared/maps/peeled_map.h"

#include "techniques/gl/api.h"
#include "techniques/shared/maps/linear_depth_map.h"

#include <cstddef>

namespace shadowbench::techniques {

PeeledMap::PeeledMap(int side, int layers, Bias bias)
    : layers_(layers), layered_(gl::Format::RGBA32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      depths_{gl::Texture(gl::Format::Depth32F, {side, side}), gl::Texture(gl::Format::Depth32F, {side, side})},
      nearest_("shared/maps/linear_depth_map.vert", "shared/maps/linear_depth_map.frag"),
      peel_("shared/maps/linear_depth_map.vert", "shared/maps/linear_depth_map.frag", {{"PEEL", "1"}}), bias_(bias) {}

void PeeledMap::draw(const LightView& light, const Frame& frame) {
    {
        const auto pass = frame.pass("depth map");
        gl::RenderTarget({&layered_}).clearColour(0, glm::vec4(gl::nothingInTheWay));
        drawLayer(nearest_, 0, light, frame.scene);
    }
    for (int layer = 1; layer < layers_; ++layer) {
        const auto pass = frame.pass("depth peeling");
        peel_.set("depthBefore", depths_[static_cast<std::size_t>(layer - 1) % 2]);
        drawLayer(peel_, layer, light, frame.scene);
    }
}

void PeeledMap::drawLayer(gl::Program& program, int layer, const LightView& light, const gl::SceneBuffers& scene) {
    const gl::RenderTarget target({&layered_, &depths_[static_cast<std::size_t>(layer) % 2]});
    target.clearDepth(1);
    target.bind();
    const double constant = bias_.units * depthStep * light.far;
    program.set("inverseRange", inverseRange(light)).set("bias", glm::vec2(bias_.factor, constant));
    const CasterPass casters(program, light, Bias{});
    if (layer > 0) glEnable(GL_CULL_FACE); // back faces
    const auto channel = [&](int number) { return static_cast<GLboolean>(layer == number ? GL_TRUE : GL_FALSE); };
    glColorMask(channel(0), channel(1), channel(2), channel(3));
    scene.draw();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_CULL_FACE);
}

} // namespace shadowbench::techniques
