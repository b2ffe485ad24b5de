#include "techniques/shared/filters/nearest_texel.h"

#include "techniques/shared/maps/light_receiver.h"

#include <glm/geometric.hpp>

namespace shadowbench::techniques {

glm::dvec2 texelReach(const Light& light, const LightView& view, int side) {
    const glm::dvec2 halfSize(0.5 * glm::length(light.u), 0.5 * glm::length(light.v));
    return view.span / halfSize / static_cast<double>(side);
}

void setNearestTexel(gl::Program& program, const Light& light, const LightView& view, int side, int radius,
                     bool followPlane) {
    setLightReceiver(program, view, followPlane);
    program.set("texelReach", glm::vec2(texelReach(light, view, side))).set("searchRadius", radius);
}

} // namespace shadowbench::techniques
