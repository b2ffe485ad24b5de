#include "techniques/shared/maps/linearised_map.h"

namespace shadowbench::techniques {

glm::vec4 linearisation(const LightView& light, double bias) {
    if (light.perspective) return {light.near, 0, light.near / light.far, bias};
    return {light.near, light.far - light.near, 1, bias};
}

glm::vec4 unitLinearisation(const LightView& light, double bias) {
    const double share = light.perspective ? light.near / light.far : 1;
    return {0, share, share, bias / (light.far - light.near)};
}

glm::dvec4 unitDepthFromWorld(const LightView& light) {
    return (light.depthFromWorld - glm::dvec4(0, 0, 0, light.near)) / (light.far - light.near);
}

Bias drawnBias(Bias bias) {
    bias.units = 0;
    return bias;
}

LinearisedMap::LinearisedMap(int side, Bias bias) : units_(bias.units), depth_(side, drawnBias(bias), Lookup::Raw) {}

void LinearisedMap::draw(const LightView& light, const Frame& frame) {
    depth_.draw(light, frame);
    const double constant = units_ * depthStep * light.far;
    metres_ = linearisation(light, constant);
    unit_ = unitLinearisation(light, constant);
}

void LinearisedMap::bind(gl::Program& program, const glm::vec4& linearisation) const {
    program.set("windowDepths", depth_.texture()).set("linearisation", linearisation);
}

} // namespace shadowbench::techniques
