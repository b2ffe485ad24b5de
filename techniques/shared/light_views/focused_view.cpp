#include "techniques/shared/light_views/focused_view.h"

#include "techniques/shared/light_views/visible_part.h"

#include <array>
#include <vector>

namespace shadowbench::techniques {

LightView fitFocused(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect,
                     std::span<const glm::dvec4> within) {
    LightView whole = fitToScene(light, snapshot);
    const std::array<glm::dvec4, 6> lit = frustumPlanes(whole.clipFromWorld);
    std::vector<glm::dvec4> halfSpaces(lit.begin(), lit.end());
    halfSpaces.insert(halfSpaces.end(), within.begin(), within.end());
    const std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, halfSpaces);
    if (body.size() < 3) return whole;
    return fitToPoints(light, body, snapshot.camera.target);
}

} // namespace shadowbench::techniques
