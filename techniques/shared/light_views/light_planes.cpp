#include "techniques/shared/light_views/light_planes.h"

#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <span>

namespace shadowbench::techniques {
namespace {

bool contains(const Bounds& box, const glm::dvec3& p) { return glm::clamp(p, box.low, box.high) == p; }

} // namespace

std::vector<LightView> lightPlanes(const Light& light, const Snapshot& snapshot) {
    if (light.kind == LightKind::Directional) return {fitToScene(light, snapshot)};
    const std::vector<glm::dvec3> corners = boundingCorners(snapshot);
    if (contains(snapshot.bounds(), light.centre)) return cubeViews(light.centre, corners);
    const LightView whole = fitToScene(light, snapshot);
    if (std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& p) { return holds(whole, p); })) return {whole};
    return cubeViews(light.centre, corners);
}

LightView partOf(const LightView& view, const glm::dvec2& low, const glm::dvec2& high) {
    LightView part = view;
    const glm::dvec2 zoom = 1.0 / (high - low);
    const glm::dvec2 middle = low + high - 1.0; // clip space, as is all below
    const glm::dmat4 shift = glm::translate(glm::dmat4(1), glm::dvec3(-middle, 0));
    part.clipFromWorld = glm::scale(glm::dmat4(1), glm::dvec3(zoom, 1)) * shift * view.clipFromWorld;
    part.span = (high - low) * view.span;
    return part;
}

std::vector<bool> castersIn(const LightView& view, const std::vector<glm::dvec3>& corners) {
    const std::array<glm::dvec4, 6> frustum = frustumPlanes(view.clipFromWorld);
    std::vector<glm::dvec4> sides(frustum.begin(), frustum.begin() + 4); // casters beyond near and far are drawn too
    if (view.perspective) sides.push_back(view.depthFromWorld);
    const auto beside = [&](std::span<const glm::dvec3> box) {
        return std::any_of(sides.begin(), sides.end(), [&](const glm::dvec4& side) {
            return std::all_of(box.begin(), box.end(),
                               [&](const glm::dvec3& p) { return glm::dot(side, glm::dvec4(p, 1)) < 0; });
        });
    };
    std::vector<bool> casters;
    for (std::size_t i = 0; i + 8 <= corners.size(); i += 8) casters.push_back(!beside(std::span(corners).subspan(i, 8)));
    return casters;
}

} // namespace shadowbench::techniques
