#include "harness/metrics/surface_motion.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace shadowbench::metrics {
namespace {

/// A triangle's corners, in one of two poses.
struct Corners {
    glm::dvec3 a, b, c;

    Corners(const Mesh& mesh, const glm::uvec3& t)
        : a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]) {}
    [[nodiscard]] glm::dvec3 at(const glm::dvec3& weights) const { return weights.x * a + weights.y * b + weights.z * c; }
};

/// Barycentric, of the point's foot on the plane; moved into the triangle where that lies outside, roughly so: the nearest
/// triangle of all is one that the point is on, to rounding.
glm::dvec3 weightsIn(const Corners& t, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double area = glm::dot(normal, normal);
    if (area == 0) return {1, 0, 0};
    const double b = glm::dot(glm::cross(point - t.a, t.c - t.a), normal) / area,
                 c = glm::dot(glm::cross(t.b - t.a, point - t.a), normal) / area;
    const glm::dvec3 within = glm::max(glm::dvec3(1 - b - c, b, c), glm::dvec3(0));
    return within / (within.x + within.y + within.z);
}

/// Where the point of `now` that lies nearest to `point` is in `before`.
glm::dvec3 inPose(const Mesh& now, const Mesh& before, const glm::dvec3& point) {
    double least = std::numeric_limits<double>::infinity();
    glm::dvec3 result = point;
    for (const glm::uvec3& triangle : now.triangles) {
        const Corners corners(now, triangle);
        const glm::dvec3 weights = weightsIn(corners, point), away = corners.at(weights) - point;
        if (const double distance = glm::dot(away, away); distance < least) {
            least = distance;
            result = Corners(before, triangle).at(weights);
        }
    }
    return result;
}

} // namespace

SurfaceMotion::SurfaceMotion(const Snapshot& now) {
    for (const Batch& batch : now.batches)
        for (const Placement& placement : batch.placements)
            if (batch.moves(placement)) moving_[placement.id] = {&batch, &placement, glm::inverse(placement.world)};
}

glm::dvec3 SurfaceMotion::before(std::uint32_t id, const glm::dvec3& point) const {
    const auto found = moving_.find(id);
    if (found == moving_.end()) return point;
    const auto& [batch, placement, fromWorld] = found->second;
    if (!batch->previousMesh) return (placement->previous * fromWorld) * glm::dvec4(point, 1);
    const glm::dvec3 local(fromWorld * glm::dvec4(point, 1));
    return placement->previous * glm::dvec4(inPose(*batch->mesh, *batch->previousMesh, local), 1);
}

} // namespace shadowbench::metrics
