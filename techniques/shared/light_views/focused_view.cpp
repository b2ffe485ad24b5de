#include "techniques/shared/light_views/focused_view.h"

#include "techniques/shared/light_views/visible_part.h"

namespace shadowbench::techniques {

LightView fitFocused(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect) {
    LightView whole = fitToScene(light, snapshot);
    const std::vector<glm::dvec3> body = visiblePart(snapshot.bounds(), camera, aspect, frustumPlanes(whole.clipFromWorld));
    if (body.size() < 3) return whole;
    return fitToPoints(light, body);
}

} // namespace shadowbench::techniques
