#include "techniques/maps/sm-log/log_view.h"

#include "techniques/shared/light_views/fitting.h"
#include "techniques/shared/light_views/lispsm_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shadowbench::techniques {
namespace {

constexpr double leastWarp = 20; // n / d above which log v is even to rounding

} // namespace

glm::dvec2 LogView::onMap(const glm::dvec2& at) const {
    return {(at.x / at.y - left) / (right - left), std::log(at.y / near) / std::log(far / near)};
}

double logNear(double d, double z0, double z1) {
    if (z0 <= 0 || z1 <= z0) return leastWarp * d;
    return std::min(d / (z1 / z0 - 1), leastWarp * d);
}

LogView fitLog(const Light& light, const Snapshot& snapshot, const Camera& camera, double aspect) {
    TurnedLight seen = turnedAlongView(light, snapshot, camera, aspect);
    if (seen.body.size() < 3) { // no pixel is tested then
        seen.body = seen.view.covered;
        seen.plane = seen.view.clipFromWorld;
        seen.box = boundsOf(seen.plane, seen.body);
    }
    const double d = std::max(seen.box.high.y - seen.box.low.y, 1e-12);
    LogView view;
    view.near = logNear(d, seen.z0, seen.z1);
    view.far = view.near + d;
    const glm::dvec3 centre(seen.nearest.x, seen.box.low.y - view.near, 0);
    view.planeFromWorld = glm::translate(glm::dmat4(1), -centre) * seen.plane;
    Bounds slopes;
    for (const glm::dvec3& p : seen.body) {
        const glm::dvec3 at = divided(view.planeFromWorld * glm::dvec4(p, 1));
        slopes.add({at.x / std::max(at.y, view.near), 0, 0});
    }
    view.left = slopes.low.x;
    view.right = std::max(slopes.high.x, slopes.low.x + 1e-12);
    return view;
}

std::optional<glm::dvec2> texelAt(const LogView& view, const glm::dvec3& world, int side) {
    const glm::dvec4 h = view.planeFromWorld * glm::dvec4(world, 1);
    if (h.w <= 0 || h.y <= 0) return std::nullopt;
    const glm::dvec2 at = view.onMap(glm::dvec2(h) / h.w);
    const bool inside = at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1;
    return inside ? std::optional(static_cast<double>(side) * at) : std::nullopt;
}

} // namespace shadowbench::techniques
