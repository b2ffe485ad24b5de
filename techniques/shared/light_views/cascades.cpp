#include "techniques/shared/light_views/cascades.h"

#include "techniques/shared/light_views/visible_part.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

} // namespace shadowbench::techniques
