#include "techniques/maps/midpoint_map.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

MidpointMap::MidpointMap(int side, Lookup lookup)
    : first_(side, Bias{}, Lookup::Raw),
      second_(gl::Format::Depth32F, {side, side}, gl::Filter::Nearest, gl::Wrap::BorderFar),
      middle_(gl::Format::Depth32F, {side, side},
              lookup == Lookup::CompareBilinear ? gl::Filter::Linear : gl::Filter::Nearest, gl::Wrap::BorderFar),
      secondTarget_{&second_}, middleTarget_{&middle_}, peel_("maps/depth_map.vert", "maps/midpoint_peel.frag"),
      mean_(gl::Program::screen("maps/midpoint_mean.frag")) {
    if (lookup != Lookup::Raw) middle_.compareDepth();
}

void MidpointMap::draw(const LightView& light, const gl::SceneBuffers& scene) {
    first_.draw(light, scene);

    secondTarget_.clearDepth(1);
    secondTarget_.bind();
    peel_.set("firstDepth", first_.texture());
    {
        const CasterPass pass(peel_, light, Bias{});
        scene.draw();
    }

    mean_.set("firstDepth", first_.texture()).set("secondDepth", second_);
    middleTarget_.bind();
    mean_.drawScreenDepth();
}

} // namespace shadowbench::techniques
