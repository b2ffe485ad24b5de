#include "groundtruth/cgal/plan/shadow_polygons_plane.h"

#include "base/error.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace shadowbench::groundtruth::plan {
namespace {

/// The axis along which the normal is longest; up to rounding, which any of the longest ones suits.
PlaneAxes axesOf(const Triangle& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]), n = glm::abs(normal);
    PlaneAxes axes;
    axes.dropped = n.y >= n.x && n.y >= n.z ? 1 : n.x >= n.z ? 0 : 2;
    axes.u = axes.dropped == 0 ? 2 : 0;
    axes.v = axes.dropped == 1 ? 2 : 1;

    const double slopeU = -normal[axes.u] / normal[axes.dropped], slopeV = -normal[axes.v] / normal[axes.dropped];
    axes.height = {t[0][axes.dropped] - slopeU * t[0][axes.u] - slopeV * t[0][axes.v], slopeU, slopeV};
    return axes;
}

glm::dvec2 rounded(const ExactPoint& p) { return {CGAL::to_double(p.x().exact()), CGAL::to_double(p.y().exact())}; }

std::vector<glm::dvec2> rounded(const ExactRing& ring) {
    std::vector<glm::dvec2> result;
    for (const ExactPoint& p : ring) result.push_back(rounded(p));
    return result;
}

} // namespace

glm::dvec3 PlaneAxes::world(const glm::dvec2& point) const {
    glm::dvec3 result;
    result[u] = point.x;
    result[v] = point.y;
    result[dropped] = height.x + height.y * point.x + height.z * point.y;
    return result;
}

double PlaneAxes::stretch() const { return std::sqrt(1 + height.y * height.y + height.z * height.z); }

std::size_t ReceiverRegion::vertices() const {
    std::size_t count = 0;
    for (const PlanarPolygon& polygon : polygons) {
        count += polygon.outer.size();
        for (const std::vector<glm::dvec2>& hole : polygon.holes) count += hole.size();
    }
    return count;
}

std::vector<Triangle> receiverTriangles(const Snapshot& snapshot, const hard::PlanarReceiver& receiver) {
    if (receiver.triangles.empty()) throw InternalError("A planar receiver without triangles has no plane.");
    for (const Batch& batch : snapshot.batches)
        for (const Placement& placement : batch.placements) {
            if (placement.id != receiver.id) continue;
            std::vector<Triangle> result;
            for (const std::uint32_t index : receiver.triangles) {
                const glm::uvec3& corner = batch.mesh->triangles.at(index);
                const auto vertex = [&](int i) { return worldVertex(placement.world, batch.mesh->positions[corner[i]]); };
                result.push_back({vertex(0), vertex(1), vertex(2)});
            }
            return result;
        }
    throw InternalError("The snapshot has no surface " + std::to_string(receiver.id) + ".");
}

PlaneFrame::PlaneFrame(const Triangle& receiver, const glm::dvec4& light)
    : triangle(facing(receiver, light)), axes(axesOf(receiver)) {
    orientation = CGAL::orientation(drop(triangle[0]), drop(triangle[1]), drop(triangle[2]));
}

std::vector<CoverEdge> receiverEdges(const std::vector<Triangle>& receiver, const PlaneFrame& frame) {
    std::vector<CoverEdge> edges;
    for (const Triangle& t : receiver) {
        const std::array<ExactPoint, 3> corners{frame.drop(t[0]), frame.drop(t[1]), frame.drop(t[2])};
        const int turn = CGAL::orientation(corners[0], corners[1], corners[2]);
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({corners[i], corners[(i + 1) % 3], {0, turn}});
    }
    return edges;
}

ReceiverRegion rounded(std::uint32_t id, const PlaneAxes& axes, ExactRegion region) {
    ReceiverRegion result{id, axes, {}, areaOf(region), std::make_shared<const ExactRegion>(std::move(region))};
    for (const ExactPolygon& polygon : result.exact->polygons) {
        PlanarPolygon& last = result.polygons.emplace_back(PlanarPolygon{rounded(polygon.outer), {}});
        for (const ExactRing& hole : polygon.holes) last.holes.push_back(rounded(hole));
    }
    return result;
}

} // namespace shadowbench::groundtruth::plan
