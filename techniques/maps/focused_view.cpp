#include "techniques/maps/focused_view.h"

#include "techniques/maps/visible_part.h"

namespace shadowbench::techniques {

LightView fitFocused(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect) {
    LightView whole = fitToScene(light.centreOnly(), snapshot);
    const std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, frustumPlanes(whole.clipFromWorld));
    if (body.size() < 3) return whole;
    return fitToPoints(light.centreOnly(), body);
}

} // namespace shadowbench::techniques
