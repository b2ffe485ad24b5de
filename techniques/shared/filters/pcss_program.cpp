#include "techniques/shared/filters/pcss_program.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {

PcssTaps PcssTaps::parse(const std::string& text) {
    const std::size_t plus = text.find('+');
    return {std::stoi(text.substr(0, plus)), std::stoi(text.substr(plus + 1)), text == "25+49"};
}

gl::Defines PcssTaps::defines() const {
    return {{"SEARCH_TAPS", std::to_string(search)}, {"FILTER_TAPS", std::to_string(filter)}};
}

Region tapRegion(const Light& light) { return light.kind == LightKind::Disk ? Region::Disk : Region::Square; }

void setLightReceiver(gl::Program& program, const Light& light, const LightView& view, const LinearDepthMap& map,
                      bool followPlane) {
    program.set("mapFromWorld", mapFromWorld(view))
        .set("depthFromWorld", glm::vec4(view.depthFromWorld))
        .set("linearDepth", map.texture())
        .set("lightHalfSize", 0.5F * glm::vec2(glm::length(light.u), glm::length(light.v)))
        .set("mapSpan", glm::vec2(view.span))
        .set("nearDepth", static_cast<float>(view.near))
        .set("followPlane", followPlane ? 1.0F : 0.0F);
}

void setPcss(gl::Program& program, const PcssTaps& taps, const Light& light, const LightView& view,
             const LinearDepthMap& map, bool followPlane) {
    const auto points = [&](int count) {
        return taps.grid ? gridTaps(static_cast<int>(std::lround(std::sqrt(count)))) : poissonTaps(count, tapRegion(light));
    };
    const std::vector<glm::vec2> search = points(taps.search);
    const std::vector<glm::vec2> filter = points(taps.filter);
    setLightReceiver(program, light, view, map, followPlane);
    program.set("searchTaps", search).set("filterTaps", filter);
}

} // namespace shadowbench::techniques
