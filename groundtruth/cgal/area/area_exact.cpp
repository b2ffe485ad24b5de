// Each triangle is clipped in space by the planes through the point and the light's sides and by the light's plane, and
// projected; an arrangement of all borders tells the winding number of every face.
#include "groundtruth/cgal/area/area_exact.h"

#include "groundtruth/cgal/area/area_shape.h"

#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace shadowbench::groundtruth::area {
namespace {

using Number = CGAL::Exact_rational;
using Space = CGAL::Simple_cartesian<Number>;
using Point = Space::Point_3;
using Vector = Space::Vector_3;
using Plane = Space::Plane_3;
using Polygon = std::vector<Point>;
using LightPoint = std::pair<Number, Number>;

Point exactPoint(const glm::dvec3& p) { return {p.x, p.y, p.z}; }
Vector exactVector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Point meeting(const Point& from, const Vector& direction, const Plane& plane) {
    const Vector normal = plane.orthogonal_vector();
    const Number share = (plane.point() - from) * normal / (direction * normal);
    return from + share * direction;
}

/// The part on the plane's positive side. `open`: a segment, not a polygon.
Polygon clipped(const Polygon& polygon, const Plane& plane, bool open) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const CGAL::Oriented_side sideA = plane.oriented_side(a), sideB = plane.oriented_side(b);
        if (sideA != CGAL::ON_NEGATIVE_SIDE) result.push_back(a);
        const bool isEdge = !open || i + 1 < polygon.size();
        if (isEdge && sideA * sideB < 0) result.push_back(meeting(a, b - a, plane));
    }
    return result;
}

Plane turnedTo(const Plane& plane, const Point& inside) {
    return plane.has_on_negative_side(inside) ? plane.opposite() : plane;
}

/// The light as the exact point sees it.
class ExactView {
public:
    ExactView(const Light& light, const SurfacePoint& point)
        : eye_(receiverPoint(point)), centre_(exactPoint(light.centre)), u_(exactVector(light.u)),
          flat_(light.kind == LightKind::Line), v_(flat_ ? CGAL::cross_product(u_, centre_ - eye_) : exactVector(light.v)),
          plane_(centre_, CGAL::cross_product(u_, v_)) {}

    [[nodiscard]] bool edgeOn() const { return v_ == CGAL::NULL_VECTOR || plane_.has_on(eye_); }

    /// Planes whose positive sides enclose what can hide a part of the light (of the square around a disk, made a little
    /// larger).
    [[nodiscard]] std::vector<Plane> shaft(LightKind kind) const {
        const Number reach(lightWindow(kind));
        std::vector<Plane> planes{turnedTo(plane_, eye_)};
        const auto add = [&](const Vector& side, const Vector& along) {
            for (const Vector& shift : {side, -side})
                planes.push_back(turnedTo(Plane(eye_, centre_ + shift, centre_ + shift + along), centre_));
        };
        add(reach * u_, v_);
        if (!flat_) add(reach * v_, u_);
        return planes;
    }

    /// Light coordinates of the point behind `p`.
    [[nodiscard]] LightPoint behind(const Point& p) const {
        const Vector q = meeting(eye_, p - eye_, plane_) - centre_;
        const Number uu = u_ * u_, uv = u_ * v_, vv = v_ * v_, qu = q * u_, qv = q * v_;
        const Number area = uu * vv - uv * uv;
        return {(qu * vv - qv * uv) / area, (qv * uu - qu * uv) / area};
    }

    /// 1 if the triangle turns left in light coordinates, 0 if its plane contains the point.
    [[nodiscard]] int turn(const Polygon& t) const {
        const CGAL::Orientation seen = CGAL::orientation(eye_, t[0], t[1], t[2]);
        return seen * CGAL::orientation(eye_, centre_, centre_ + u_, centre_ + v_);
    }

    /// Where the plane of point and line light meets a triangle; a corner in it counts as lying on its positive side.
    [[nodiscard]] Polygon section(const Polygon& t) const {
        const Plane cut(centre_, -v_);
        Polygon result;
        for (int i = 0; i < 3; ++i) {
            const Point &a = t[i], &b = t[(i + 1) % 3];
            if (cut.has_on_negative_side(a) != cut.has_on_negative_side(b)) result.push_back(meeting(a, b - a, cut));
        }
        return result;
    }

    [[nodiscard]] bool before(const Polygon& polygon) const {
        const Plane light = turnedTo(plane_, eye_);
        return std::ranges::any_of(polygon, [&](const Point& p) { return light.has_on_positive_side(p); });
    }

private:
    static Point receiverPoint(const SurfacePoint& point) {
        const Plane plane(exactPoint(point.receiver[0]), exactPoint(point.receiver[1]), exactPoint(point.receiver[2]));
        return meeting(exactPoint(point.ray.origin), exactVector(point.ray.direction), plane);
    }

    Point eye_, centre_;
    Vector u_;
    bool flat_;
    Vector v_; // a line light's is normal to the plane of point and light
    Plane plane_;
};

/// The part of a triangle (for a line light: of its section) that hides something; empty if none does.
Polygon hidingPart(const ExactView& view, const std::vector<Plane>& shaft, Polygon polygon, bool open) {
    if (!view.before(polygon)) return {};
    for (const Plane& plane : shaft) polygon = clipped(polygon, plane, open);
    return polygon;
}

double exactVisibleLength(const std::vector<Polygon>& triangles, const ExactView& view, const std::vector<Plane>& shaft) {
    std::vector<LightPoint> hidden; // from, to
    for (const Polygon& triangle : triangles) {
        const Polygon part = hidingPart(view, shaft, view.section(triangle), true);
        if (part.size() < 2) continue;
        const Number a = view.behind(part[0]).first, b = view.behind(part[1]).first;
        hidden.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::ranges::sort(hidden);
    Number visible(0), reached(-0.5);
    for (const LightPoint& part : hidden) {
        if (part.first > reached) visible += part.first - reached;
        reached = std::max(reached, part.second);
    }
    return CGAL::to_double(Number(visible + Number(0.5) - reached));
}

/// What the left side of a directed edge has more than its right side; also the counts of a face.
struct Counts {
    int covers = 0, inner = 0, outer = 0;
    Counts operator+(const Counts& o) const { return {covers + o.covers, inner + o.inner, outer + o.outer}; }
    Counts operator-() const { return {-covers, -inner, -outer}; }
    friend bool operator==(const Counts&, const Counts&) = default;
};

struct Sum {
    Counts operator()(const Counts& a, const Counts& b) const { return a + b; }
};

using Plain = CGAL::Exact_predicates_exact_constructions_kernel;
using Segments = CGAL::Arr_segment_traits_2<Plain>;
using Traits = CGAL::Arr_curve_data_traits_2<Segments, Counts, Sum>;
using Dcel = CGAL::Arr_face_extended_dcel<Traits, std::optional<Counts>>;
using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;

/// Sums borders per undirected edge, directed from its lexicographically smaller end. Edges are cut at all corners that lie
/// on them, so that edges that overlap become equal and are summed: on some overlaps CGAL 5.5's sweep fails an assertion of
/// its own.
class Borders {
public:
    void add(const std::vector<LightPoint>& polygon, const Counts& counts) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const LightPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            if (a != b) edges_.push_back({a, b, counts});
        }
    }

    [[nodiscard]] Arrangement arrangement() const {
        const auto point = [](const LightPoint& p) { return Plain::Point_2(Plain::FT(p.first), Plain::FT(p.second)); };
        std::vector<Traits::X_monotone_curve_2> curves;
        for (const auto& [ends, counts] : summed())
            if (!(counts == Counts()))
                curves.emplace_back(Segments::X_monotone_curve_2(point(ends.first), point(ends.second)), counts);
        Arrangement result;
        CGAL::insert(result, curves.begin(), curves.end());
        return result;
    }

private:
    struct Edge {
        LightPoint from, to;
        Counts counts;
    };
    using Sums = std::map<std::pair<LightPoint, LightPoint>, Counts>;

    /// A corner, and where it is to double precision.
    struct Corner {
        LightPoint exact;
        glm::dvec2 near;
    };

    static glm::dvec2 rounded(const LightPoint& p) { return {CGAL::to_double(p.first), CGAL::to_double(p.second)}; }

    [[nodiscard]] Sums summed() const {
        std::set<LightPoint> points;
        for (const Edge& edge : edges_) points.insert(edge.from);
        std::vector<Corner> corners;
        for (const LightPoint& p : points) corners.push_back({p, rounded(p)});

        Sums sums;
        for (const Edge& edge : edges_) {
            const bool rises = edge.from < edge.to;
            const LightPoint &low = rises ? edge.from : edge.to, &high = rises ? edge.to : edge.from;
            std::vector<LightPoint> cuts{low};
            for (const Corner& corner : corners) // in lexicographic order, as along the edge
                if (low < corner.exact && corner.exact < high && liesOn(corner, low, high)) cuts.push_back(corner.exact);
            cuts.push_back(high);
            for (std::size_t i = 1; i < cuts.size(); ++i) {
                Counts& sum = sums[{cuts[i - 1], cuts[i]}];
                sum = sum + (rises ? edge.counts : -edge.counts);
            }
        }
        return sums;
    }

    static bool liesOn(const Corner& corner, const LightPoint& low, const LightPoint& high) {
        const glm::dvec2 a = rounded(low), along = rounded(high) - a, away = corner.near - a;
        constexpr double clear = 1e-12; // coordinates are of the order of 1: rounding moves the product by some 1e-15
        if (std::abs(along.x * away.y - along.y * away.x) > clear) return false;
        return (high.first - low.first) * (corner.exact.second - low.second) ==
               (high.second - low.second) * (corner.exact.first - low.first);
    }

    std::vector<Edge> edges_;
};

/// What the face left of a halfedge has more than the one to its right.
Counts across(Arrangement::Halfedge_const_handle edge) {
    return edge->direction() == CGAL::ARR_LEFT_TO_RIGHT ? edge->curve().data() : -edge->curve().data();
}

/// Visits the borders of a face, holes and all.
template <typename Visit>
void forEachBorder(Arrangement::Face_handle face, const Visit& visit) {
    const auto around = [&](Arrangement::Ccb_halfedge_circulator start) {
        Arrangement::Ccb_halfedge_circulator edge = start;
        do visit(Arrangement::Halfedge_handle(edge));
        while (++edge != start);
    };
    for (auto ccb = face->outer_ccbs_begin(); ccb != face->outer_ccbs_end(); ++ccb) around(*ccb);
    for (auto ccb = face->inner_ccbs_begin(); ccb != face->inner_ccbs_end(); ++ccb) around(*ccb);
}

void countFaces(Arrangement& arrangement) {
    arrangement.unbounded_face()->set_data(Counts());
    std::vector<Arrangement::Face_handle> pending{arrangement.unbounded_face()};
    while (!pending.empty()) {
        const Arrangement::Face_handle face = pending.back();
        pending.pop_back();
        forEachBorder(face, [&](Arrangement::Halfedge_handle edge) {
            const Arrangement::Face_handle next = edge->twin()->face();
            if (next->data()) return;
            next->set_data(*face->data() + across(edge->twin()));
            pending.push_back(next);
        });
    }
}

/// Green's theorem over the borders of all faces for which `counts` is true.
template <typename Counted>
double area(const Arrangement& arrangement, const Counted& counted) {
    Number twice(0);
    for (auto edge = arrangement.halfedges_begin(); edge != arrangement.halfedges_end(); ++edge) {
        if (!counted(*edge->face()->data()) || counted(*edge->twin()->face()->data())) continue;
        const Plain::Point_2 &a = edge->source()->point(), &b = edge->target()->point();
        twice += a.x().exact() * b.y().exact() - a.y().exact() * b.x().exact();
    }
    return 0.5 * CGAL::to_double(twice);
}

std::vector<LightPoint> exactPolygon(const LightPolygon& polygon) {
    std::vector<LightPoint> result;
    for (const glm::dvec2& p : polygon) result.emplace_back(p.x, p.y);
    return result;
}

LightAreas exactAreas(const std::vector<Polygon>& triangles, const ExactView& view, const std::vector<Plane>& shaft,
                      const LightShape& shape) {
    Borders borders;
    borders.add(exactPolygon(shape.inner), {0, 1, 0});
    borders.add(exactPolygon(shape.outer), {0, 0, 1});
    for (const Polygon& triangle : triangles) {
        const Polygon part = hidingPart(view, shaft, triangle, false);
        std::vector<LightPoint> seen;
        for (const Point& p : part) seen.push_back(view.behind(p));
        borders.add(seen, {view.turn(triangle), 0, 0});
    }
    Arrangement arrangement = borders.arrangement();
    countFaces(arrangement);
    return {area(arrangement, [](const Counts& c) { return c.inner > 0 && c.covers == 0; }),
            area(arrangement, [](const Counts& c) { return c.inner > 0 && c.covers > 0; }),
            area(arrangement, [](const Counts& c) { return c.outer > 0 && c.covers == 0; }),
            area(arrangement, [](const Counts& c) { return c.outer > 0 && c.covers > 0; })};
}

} // namespace

VisibleFraction exactVisibleFraction(const std::vector<Triangle>& candidates, const Light& light,
                                     const SurfacePoint& point) {
    const ExactView view(light, point);
    if (view.edgeOn()) return {0, 1};
    std::vector<Polygon> triangles;
    for (const Triangle& t : candidates) {
        Polygon triangle{exactPoint(t[0]), exactPoint(t[1]), exactPoint(t[2])};
        if (view.turn(triangle) != 0) triangles.push_back(std::move(triangle));
    }
    const std::vector<Plane> shaft = view.shaft(light.kind);
    if (light.kind == LightKind::Line) {
        const double visible = exactVisibleLength(triangles, view, shaft);
        return {visible, visible};
    }
    const LightShape shape = lightShape(light.kind);
    return enclosedFraction(exactAreas(triangles, view, shaft, shape), shape);
}

} // namespace shadowbench::groundtruth::area
