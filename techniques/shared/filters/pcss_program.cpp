#include "techniques/shared/filters/pcss_program.h"

#include "techniques/shared/maps/light_receiver.h"
#include "techniques/shared/sampling/sampling.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace shadowbench::techniques {
namespace {

std::vector<glm::vec2> tapsOf(int count, bool grid, Region region) {
    return grid ? gridTaps(static_cast<int>(std::lround(std::sqrt(count)))) : keptPoissonTaps(count, region);
}

} // namespace

PcssTaps PcssTaps::parse(const std::string& text) {
    const std::size_t plus = text.find('+');
    return {std::stoi(text.substr(0, plus)), std::stoi(text.substr(plus + 1)), text == "25+49"};
}

gl::Defines PcssTaps::defines() const {
    return {{"SEARCH_TAPS", std::to_string(search)}, {"FILTER_TAPS", std::to_string(filter)}};
}

void setBlockerSearch(gl::Program& program, const Light& light, const LightView& view, const LinearisedMap& map,
                      bool followPlane) {
    setLightReceiver(program, view, followPlane);
    map.bindTo(program);
    program.set("lightHalfSize", 0.5F * glm::vec2(glm::length(light.u), glm::length(light.v)))
        .set("mapSpan", glm::vec2(view.span))
        .set("nearDepth", static_cast<float>(view.near));
}

void setPcss(gl::Program& program, const PcssTaps& taps, const Light& light, const LightView& view, const LinearisedMap& map,
             bool followPlane) {
    const Region region = light.kind == LightKind::Disk ? Region::Disk : Region::Square;
    setBlockerSearch(program, light, view, map, followPlane);
    program.set("searchTaps", tapsOf(taps.search, taps.grid, region))
        .set("filterTaps", tapsOf(taps.filter, taps.grid, region));
}

} // namespace shadowbench::techniques
