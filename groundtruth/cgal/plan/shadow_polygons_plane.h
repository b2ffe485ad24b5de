// A receiver's plane in exact plane coordinates. Internal, as shadow_polygons_region.h.
#pragma once

#include "groundtruth/cgal/geometry/triangles.h"
#include "groundtruth/cgal/plan/shadow_polygons_region.h"

#include <vector>

namespace shadowbench::groundtruth::plan {

using namespace geometry;

/// The world triangles of a receiver.
std::vector<Triangle> receiverTriangles(const Snapshot& snapshot, const hard::PlanarReceiver& receiver);

/// How a plane's coordinates lie in the world.
struct PlaneFrame {
    Triangle triangle; // turned to face the light
    PlaneAxes axes;
    int orientation; // 1 if counter-clockwise seen from the light is counter-clockwise in (u, v), else −1

    /// `light` (homogeneous) lies off the plane.
    PlaneFrame(const Triangle& receiver, const glm::dvec4& light);

    [[nodiscard]] ExactPoint drop(const glm::dvec3& v) const { return {v[axes.u], v[axes.v]}; }
};

/// Each triangle covers its inside once as `second`.
std::vector<CoverEdge> receiverEdges(const std::vector<Triangle>& receiver, const PlaneFrame& frame);

/// The region with rounded coordinates beside the exact ones.
ReceiverRegion rounded(std::uint32_t id, const PlaneAxes& axes, ExactRegion region);

} // namespace shadowbench::groundtruth::plan
