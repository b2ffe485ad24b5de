#include "techniques/shared/maps/linear_depth_map.h"

#include "techniques/gl/api.h"

#include <glm/matrix.hpp>

namespace shadowbench::techniques {

LinearDepthMap::LinearDepthMap(int side, Bias bias, Texel texel)
    : linear_(texel == Texel::Depth ? gl::Format::R32F : gl::Format::RG32F, {side, side}, gl::Filter::Nearest,
              gl::Wrap::BorderFar),
      depth_(gl::Format::Depth32F, {side, side}), target_{&linear_, &depth_},
      program_("shared/maps/linear_depth_map.vert", "shared/maps/linear_depth_map.frag",
               texel == Texel::Depth ? gl::Defines{} : gl::Defines{{"SURFACE", "1"}}),
      bias_(bias) {}

void LinearDepthMap::draw(const LightView& light, const Frame& frame) {
    const auto pass = frame.pass("depth map");
    target_.clearColour(0, glm::vec4(gl::nothingInTheWay, 0, 0, 0));
    target_.clearDepth(1);
    target_.bind();
    const double constant = bias_.units * depthStep * light.far;
    program_.set("inverseRange", inverseRange(light)).set("bias", glm::vec2(bias_.factor, constant));
    const CasterPass casters(program_, light, Bias{});
    frame.scene.draw();
}

glm::vec2 inverseRange(const LightView& light) { return glm::vec2(1.0 / glm::dvec2(light.far, light.near)); }

glm::dmat4 worldFromTexel(const LightView& light) {
    glm::dmat4 rows = glm::transpose(mapFromClip() * light.clipFromWorld);
    rows[2] = rows[3]; // w is the depth
    rows[3] = glm::dvec4(0, 0, 0, 1);
    return glm::inverse(glm::transpose(rows));
}

} // namespace shadowbench::techniques
