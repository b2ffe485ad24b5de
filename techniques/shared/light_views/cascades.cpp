#include "techniques/shared/light_views/cascades.h"

#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::techniques {

std::vector<double> practicalSplits(double near, double far, int count, double lambda) {
    std::vector<double> splits{near};
    for (int i = 1; i < count; ++i) {
        const double share = static_cast<double>(i) / count;
        splits.push_back(lambda * near * std::pow(far / near, share) + (1 - lambda) * (near + (far - near) * share));
    }
    splits.push_back(far);
    return splits;
}

std::size_t sliceOf(const std::vector<double>& splits, double depth) {
    std::size_t slice = 0;
    while (slice + 2 < splits.size() && depth > splits[slice + 1]) ++slice;
    return slice;
}

std::vector<DepthRange> sliceRanges(const std::vector<double>& splits, double blend) {
    std::vector<DepthRange> ranges{{splits[0], splits[1]}};
    for (std::size_t i = 1; i + 1 < splits.size(); ++i)
        ranges.push_back({splits[i] - blend * (splits[i] - splits[i - 1]), splits[i + 1]});
    return ranges;
}

DepthRange visibleDepths(const Bounds& box, const Camera& camera, double aspect) {
    const std::vector<glm::dvec3> body = visiblePart(box, camera, aspect);
    if (body.empty()) return {camera.near, camera.far};
    const glm::dvec3 forward = camera.basis().forward;
    DepthRange range{camera.far, camera.near};
    for (const glm::dvec3& p : body) {
        const double depth = glm::dot(p - camera.eye, forward);
        range = {std::min(range.near, depth), std::max(range.far, depth)};
    }
    return range;
}

Sphere frustumSphere(const Camera& camera, double aspect) {
    const double n = camera.near, f = camera.far;
    const double up = std::tan(glm::radians(camera.fovy) / 2);
    const double slope2 = up * up * (1 + aspect * aspect); // of the frustum's edges against the view axis, squared
    // As far from the corners of both planes, but no farther than the middle of the far one, which is the ball's if the
    // frustum is wide.
    const double depth = std::min(f, 0.5 * (n + f) * (1 + slope2));
    const double radius = std::sqrt((f - depth) * (f - depth) + f * f * slope2);
    return {camera.eye + depth * camera.basis().forward, radius};
}

LightView fitStable(const Light& light, const Snapshot& snapshot, const Camera& slice, double aspect, int texels) {
    const LightView whole = fitToScene(light, snapshot);
    const Sphere ball = frustumSphere(slice, aspect);
    const double texel = 2 * ball.radius / (texels - 1); // one to spare, by which the map may lie beside the ball's box
    const auto metres = [&](const glm::dvec3& p) {       // across the light, from the corner of the scene's map
        return (0.5 * glm::dvec2(whole.clipFromWorld * glm::dvec4(p, 1)) + 0.5) * whole.span;
    };
    // The grid starts from the world's origin: the scene's box may change while things move.
    const glm::dvec2 origin = metres(glm::dvec3(0));
    const glm::dvec2 low = origin + texel * glm::floor((metres(ball.centre) - ball.radius - origin) / texel);
    return partOf(whole, low / whole.span, (low + texel * texels) / whole.span);
}

} // namespace shadowbench::techniques
