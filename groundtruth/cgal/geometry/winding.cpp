#include "groundtruth/cgal/geometry/winding.h"

#include "base/error.h"
#include "groundtruth/cgal/geometry/arithmetic.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace shadowbench::groundtruth::geometry {
namespace {

/// An edge's point in homogeneous coordinates; `plane` faces the light. The order of a and b makes w positive.
template <typename Number>
Homogeneous<Number> located(const EdgePoint& p, const Triangle& plane, const glm::dvec4& light) {
    const Vector<Number> a = vector<Number>(p.a);
    if (p.kind == EdgePointKind::Vertex) return {a, Number(1)};
    const Vector<Number> b = vector<Number>(p.b), n = normal<Number>(plane);
    if (p.kind == EdgePointKind::PlaneContact) {
        const Vector<Number> origin = vector<Number>(plane[0]);
        const Number above = dot(n, a - origin), below = dot(n, b - origin);
        return {above * b - below * a, above - below};
    }
    const Vector<Number> level = vector<Number>(glm::dvec3(light));
    const Number below = dot(n, level - a), above = dot(n, level - b);
    return {below * b - above * a, below - above};
}

/// Seen from the light along its line to p: 1 where x, y turn left around p. `x` and `y` give homogeneous points.
template <typename X, typename Y>
int turnAround(const ReceiverPoint& point, const glm::dvec4& light, const X& x, const Y& y) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const Homogeneous<Number>& p = homogeneous(point, tag);
        const Vector<Number> l = vector<Number>(glm::dvec3(light));
        const Vector<Number> axis = light.w == 0 ? l : p.w * l - p.xyz;
        const Homogeneous<Number> first = x(tag), second = y(tag);
        return dot(axis, cross(p.w * first.xyz - first.w * p.xyz, p.w * second.xyz - second.w * p.xyz));
    });
}

/// A corner of the plane's triangle.
auto corner(const glm::dvec3& position) {
    return [&position](auto tag) {
        using Number = typename decltype(tag)::type;
        return Homogeneous<Number>{vector<Number>(position), Number(1)};
    };
}

auto receiverPoint(const ReceiverPoint& point) {
    return [&point](auto tag) { return homogeneous(point, tag); };
}

auto edgePoint(const EdgePoint& p, const Triangle& plane, const glm::dvec4& light) {
    return [&p, &plane, &light](auto tag) {
        using Number = typename decltype(tag)::type;
        return located<Number>(p, plane, light);
    };
}

} // namespace

WindingAround::WindingAround(const ReceiverPoint& point, const Triangle& plane, const glm::dvec4& light)
    : point_(point), start_(nullptr), plane_(facing(plane, light)), light_(light) {
    chooseCorners();
    roundedWay_ = roundedWay();
}

WindingAround::WindingAround(const ReceiverPoint& point, const ReceiverPoint& start, const Triangle& plane,
                             const glm::dvec4& light)
    : point_(point), start_(&start), plane_(facing(plane, light)), light_(light) {
    chooseCorners();
    roundedWay_ = roundedWay();
}

/// Two corners that are not in line with the point (a corner and the start, if there is one).
void WindingAround::chooseCorners() {
    for (way_ = 0; way_ < 3; ++way_) {
        for (across_ = 0; across_ < 3; ++across_) {
            const auto beside = corner(plane_[across_]);
            acrossOfWay_ = start_ ? turnAround(point_, light_, beside, receiverPoint(*start_))
                                  : turnAround(point_, light_, beside, corner(plane_[way_]));
            if (acrossOfWay_ != 0) return;
        }
    }
    throw InternalError("A winding number was asked for around a point from that point itself.");
}

WindingAround::Way WindingAround::roundedWay() const {
    const Interval::Protector rounding;
    constexpr std::type_identity<Interval> tag;
    const Vector<Interval> p = homogeneous(point_, tag).xyz, l = vector<Interval>(glm::dvec3(light_));
    const Vector<Interval> to = start_ ? homogeneous(*start_, tag).xyz : vector<Interval>(plane_[way_]);
    const Vector<Interval> normal = cross(light_.w == 0 ? l : l - p, to - p);
    Way way{};
    for (int axis = 0; axis < 3; ++axis) {
        way.normal[axis] = 0.5 * (normal[axis].inf() + normal[axis].sup());
        // Twice the width, for the middle is rounded, too.
        way.error[axis] = 2 * (normal[axis].sup() - normal[axis].inf());
    }
    return way;
}

int WindingAround::sideOfWay(const EdgePoint& end) const {
    if (end.kind == EdgePointKind::Vertex) {
        const glm::dvec3 q = end.a - point_.near(), magnitude = glm::abs(roundedWay_.normal), &error = roundedWay_.error;
        const double more = glm::dot(error, glm::abs(q)) + glm::dot(magnitude + error, point_.nearError());
        if (const int sign = certainSign(glm::dot(roundedWay_.normal, q), glm::dot(magnitude, glm::abs(q)), more))
            return sign;
    }
    const auto seen = edgePoint(end, plane_, light_);
    return start_ ? turnAround(point_, light_, receiverPoint(*start_), seen)
                  : turnAround(point_, light_, corner(plane_[way_]), seen);
}

int WindingAround::sideAcross(const EdgePoint& end) const {
    return turnAround(point_, light_, corner(plane_[across_]), edgePoint(end, plane_, light_));
}

int WindingAround::turn(const EdgePoint& x, const EdgePoint& y) const {
    return turnAround(point_, light_, edgePoint(x, plane_, light_), edgePoint(y, plane_, light_));
}

int WindingAround::quarter(const EdgePoint& end) const {
    const int beside = sideOfWay(end);
    if (beside > 0) return 1;
    if (beside < 0) return 3;
    return sideAcross(end) == acrossOfWay_ ? 0 : 2;
}

/// Ends exactly on the way count as left of it, so that the sum is the change up to the sector right of the way.
void WindingAround::add(const SpatialEdge& edge) {
    const int from = sideOfWay(edge.from), to = sideOfWay(edge.to);
    if (from * to > 0) return;
    const int around = turn(edge.from, edge.to);
    if (around == 0) {
        addThrough(edge, from, to);
        return;
    }
    const bool leftFrom = from >= 0, leftTo = to >= 0;
    if (leftFrom == leftTo || around != (leftTo ? 1 : -1)) return;
    if (start_ &&
        around == turnAround(*start_, light_, edgePoint(edge.from, plane_, light_), edgePoint(edge.to, plane_, light_)))
        return; // crosses beyond the start
    change_ += around * edge.covers;
}

/// The edge is in line with the point: spokes where it runs through the point or ends there.
void WindingAround::addThrough(const SpatialEdge& edge, int sideFrom, int sideTo) {
    const int acrossFrom = sideAcross(edge.from), acrossTo = sideAcross(edge.to);
    const bool fromIsPoint = sideFrom == 0 && acrossFrom == 0, toIsPoint = sideTo == 0 && acrossTo == 0;
    if (fromIsPoint && toIsPoint) return; // the edge runs towards the light
    const bool opposite = sideFrom * sideTo < 0 || (sideFrom == 0 && sideTo == 0 && acrossFrom * acrossTo < 0);
    if (fromIsPoint || opposite) spokes_.push_back({edge.to, edge.covers});
    if (toIsPoint || opposite) spokes_.push_back({edge.from, -edge.covers});
}

WindingAround::Range WindingAround::range(int atStart) const {
    struct Placed {
        int quarter;
        const Spoke* spoke;
    };
    std::vector<Placed> order;
    for (const Spoke& spoke : spokes_) order.push_back({quarter(spoke.end), &spoke});
    const auto before = [this](const Placed& a, const Placed& b) {
        if (a.quarter != b.quarter) return a.quarter < b.quarter;
        return a.quarter % 2 == 1 && turn(a.spoke->end, b.spoke->end) > 0;
    };
    std::ranges::sort(order, before);

    int winding = atStart + change_;
    Range range{winding, winding};
    for (std::size_t i = 0; i < order.size(); ++i) {
        winding += order[i].spoke->covers;
        if (i + 1 < order.size() && !before(order[i], order[i + 1])) continue; // the same direction
        range = {std::min(range.lowest, winding), std::max(range.highest, winding)};
    }
    if (winding != atStart + change_)
        throw InternalError("The shadow edges through a receiver point are not closed; please report it.");
    return range;
}

bool inPlane(const Triangle& triangle, const ReceiverPoint& point) {
    return filteredSign([&](auto tag) {
               using Number = typename decltype(tag)::type;
               const Homogeneous<Number>& p = homogeneous(point, tag);
               return dot(normal<Number>(triangle), p.xyz - p.w * vector<Number>(triangle[0]));
           }) == 0;
}

} // namespace shadowbench::groundtruth::geometry
