// Exact winding numbers of shadow edges around a receiver point: how many triangles lie between it and the light. Neither
// trees nor segment-triangle tests are involved, only edges, each looked at on its own.
#pragma once

#include "groundtruth/cgal/geometry/predicates.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

namespace shadowbench::groundtruth::geometry {

/// What a point of an edge is named by: the vertex `a`; or where the segment from `a` (above) to `b` (below) meets the
/// receiver's plane; or where that from `a` (below) to `b` (above) meets the parallel plane through the light.
enum class EdgePointKind : std::uint8_t { Vertex, PlaneContact, LightContact };
struct EdgePoint {
    glm::dvec3 a, b;
    EdgePointKind kind;
};

/// A directed edge between the receiver's plane and the light's level: seen from the light, `covers` more triangles lie to
/// its left than to its right.
struct SpatialEdge {
    EdgePoint from, to;
    int covers;
};

/// The winding numbers around one receiver point, from a sum over edges. The view is along the line from the light to the
/// point. From a start, a point of the plane that lies on no edge, the edges crossed on the way to the point give the change
/// of the winding number; the edges through the point itself divide its neighbourhood into sectors.
class WindingAround {
public:
    /// `plane` is the receiver's, `light` homogeneous and not in it; the winding number at infinity, 0, is the start. The
    /// edges to add are all that there are.
    WindingAround(const ReceiverPoint& point, const Triangle& plane, const glm::dvec4& light);
    /// The edges to add are at least those between `start` and the point.
    WindingAround(const ReceiverPoint& point, const ReceiverPoint& start, const Triangle& plane, const glm::dvec4& light);

    void add(const SpatialEdge& edge);

    /// Lowest and highest winding number of the sectors around the point (the same where no edge passes through it), given
    /// that of the start. InternalError if the edges through the point are not closed.
    struct Range {
        int lowest, highest;
    };
    [[nodiscard]] Range range(int atStart = 0) const;

private:
    /// Part of an edge that runs from the point away; `covers` more triangles to its left.
    struct Spoke {
        EdgePoint end;
        int covers;
    };

    /// The plane through light, point and start, rounded: its side of q is the sign of normal · (q − point).
    struct Way {
        glm::dvec3 normal, error;
    };

    void chooseCorners();
    [[nodiscard]] Way roundedWay() const;
    void addThrough(const SpatialEdge& edge, int sideFrom, int sideTo);
    [[nodiscard]] int sideOfWay(const EdgePoint& end) const;  // of the plane through light, point and start
    [[nodiscard]] int sideAcross(const EdgePoint& end) const; // of the plane through light, point and the corner beside
    [[nodiscard]] int turn(const EdgePoint& x, const EdgePoint& y) const;
    [[nodiscard]] int quarter(const EdgePoint& end) const; // 0 on the way, 1 left of it, 2 behind the point, 3 right

    const ReceiverPoint& point_;
    const ReceiverPoint* start_; // null: infinity
    Triangle plane_;             // facing the light
    const glm::dvec4& light_;
    Way roundedWay_{};
    int way_ = 0;         // corner through which the ray to infinity runs
    int across_ = 0;      // corner beside the way
    int acrossOfWay_ = 0; // side of the plane through light, point and that corner on which the way lies
    int change_ = 0;
    std::vector<Spoke> spokes_;
};

/// Does the triangle's plane contain the point?
bool inPlane(const Triangle& triangle, const ReceiverPoint& point);

} // namespace shadowbench::groundtruth::geometry
