#include "techniques/shared/maps/id_map.h"

namespace shadowbench::techniques {

IdMap::IdMap(int side, Bias bias)
    : stored_(gl::Format::RG32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      depth_(gl::Format::Depth32F, {side, side}), target_{&stored_, &depth_},
      program_("shared/maps/id_map.vert", "shared/maps/id_map.frag"), bias_(bias) {}

void IdMap::draw(const LightView& light, const Frame& frame) {
    const auto pass = frame.pass("depth map");
    target_.clearColour(0, glm::vec4(gl::nothingInTheWay, 0, 0, 0));
    target_.clearDepth(1);
    target_.bind();
    const double constant = bias_.units * depthStep * light.far;
    program_.set("depthFromWorld", glm::vec4(light.depthFromWorld)).set("bias", glm::vec2(bias_.factor, constant));
    const CasterPass casters(program_, light, Bias{});
    frame.scene.draw();
}

} // namespace shadowbench::techniques
