// The exact shadows on one plane as polygons with holes: silhouette chains projected from the light onto the receiver's
// plane, their arrangement, and the winding number of each of its faces (docs/ground-truth.md, "Exact hard shadows").
#pragma once

#include "groundtruth/cgal/hard/exact.h"

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace shadowbench::groundtruth::plan {

/// Coordinates on a plane: those of the world without the axis along which the plane's normal is longest, so that nothing
/// is rounded on the way. Metres along the world's axes, not along the plane.
struct PlaneAxes {
    int dropped = 1;      // world axis: 0 x, 1 y, 2 z
    int u = 0, v = 2;     // world axes that remain: (x, z), (x, y) or (z, y)
    glm::dvec3 height{0}; // the dropped coordinate is height.x + height.y u + height.z v (rounded)

    [[nodiscard]] glm::dvec3 world(const glm::dvec2& point) const;
    [[nodiscard]] double stretch() const; // square metres on the plane per unit of area in its coordinates, ≥ 1
};

/// Counter-clockwise outside, clockwise holes, in (u, v); not closed (the first point is not repeated). Rings begin at their
/// least point, touch in single points only, and no three consecutive points lie on a line. Correctly rounded to 1e-16.
struct PlanarPolygon {
    std::vector<glm::dvec2> outer;
    std::vector<std::vector<glm::dvec2>> holes;
};

struct ExactRegion; // the same polygons with exact coordinates

/// A part of a planar receiver.
struct ReceiverRegion {
    std::uint32_t id = 0; // Placement::id of the receiver
    PlaneAxes axes;
    std::vector<PlanarPolygon> polygons; // with disjoint interiors; in ascending order of their least points
    double area = 0;                     // in (u, v), to some 1e-16 of the area around them; 0 only if there is none
    std::shared_ptr<const ExactRegion> exact;

    [[nodiscard]] std::size_t vertices() const;
};

/// What lies in shadow on a receiver, and the receiver itself: the union of its triangles. Both are closed sets without
/// needles: where shadows abut there is no seam, and a shadow of no area is none.
struct ShadowPolygons {
    ReceiverRegion receiver, shadow;
    std::optional<glm::dvec2> lightFoot; // perpendicular foot of a point light on the plane
};

/// One per receiver, in the same order. Point and directional lights, else InternalError; the light must lie in front of the
/// receivers, as it does for those of ExactScene::planarReceivers. Costs a pass over all triangles per receiver and
/// exact arithmetic for each silhouette edge and crossing.
std::vector<ShadowPolygons> shadowPolygons(const Snapshot& snapshot, const std::vector<hard::PlanarReceiver>& receivers);

/// Area (in u, v) of the points that lie in one region of a plane but not in the other: 0 exactly if they are equal.
double differingArea(const ReceiverRegion& a, const ReceiverRegion& b);

/// Labels the pixels of `primary` that see `receiver` by the exact location of their receiver points: 0 inside `shadow`, 1
/// outside, OnEdge on its border. Writes visibility and surface only; throws InternalError unless `out` has its images.
void labelByRegion(const Snapshot& snapshot, glm::ivec2 size, const PrimaryHits& primary,
                   const hard::PlanarReceiver& receiver, const ReceiverRegion& shadow, Reference& out);

} // namespace shadowbench::groundtruth::plan
