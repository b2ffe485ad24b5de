// Frames as shaded pictures, and what an eye sees of their errors.
#include "base/error.h"
#include "harness/metrics/pixels.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace shadowbench::metrics {

Shading shading(const Snapshot& snapshot, const Drawn& drawn, const Image<glm::vec3>& normals) {
    std::unordered_map<std::uint32_t, glm::vec3> colours;
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) colours[placement.id] = batch.colour;
    const glm::dvec4 light = snapshot.light.centreOnly().homogeneous();
    Shading result{Image<glm::vec3>(drawn.id.width(), drawn.id.height()),
                   Image<glm::vec3>(drawn.id.width(), drawn.id.height())};
    for (std::size_t i = 0; i < drawn.id.size(); ++i) {
        if (drawn.id[i] == 0) continue;
        const glm::vec3 colour = colours.at(drawn.id[i]);
        const glm::dvec3 toLight = glm::normalize(glm::dvec3(light) - light.w * glm::dvec3(drawn.position[i]));
        const double facing = std::max(0.0, glm::dot(glm::dvec3(normals[i]), toLight));
        result.ambient[i] = ambientShare * colour;
        result.direct[i] = (1 - ambientShare) * static_cast<float>(facing) * colour;
    }
    return result;
}

Image<glm::vec3> shaded(const Shading& shading, const Image<float>& v) {
    if (!v.sameSize(shading.direct)) throw InternalError("shading a picture of another size; draw both at one size");
    Image<glm::vec3> picture = shading.ambient;
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] += v[i] * shading.direct[i];
    return picture;
}

std::optional<double> pictureFlip(const ShadedFrame& shadedFrame) {
    requireComparable(shadedFrame.frame);
    const auto& [v, truth, mask] = shadedFrame.frame;
    if (mask.count == 0) return {};
    Image<float> shown = truth.visibility;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (mask.scored[i] != 0) shown[i] = v[i];
    return meanFlip(shadedFrame.truth, flipPicture(shaded(shadedFrame.shading, shown)));
}

} // namespace shadowbench::metrics
