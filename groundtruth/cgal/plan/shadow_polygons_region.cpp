// Arrangements of segments, covers of their faces, and the borders of sets of faces.
#include "groundtruth/cgal/plan/shadow_polygons_region.h"

#include "base/error.h"

#include <CGAL/Arr_batched_point_location.h>
#include <CGAL/Arr_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_naive_point_location.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Triangular_expansion_visibility_2.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace shadowbench::groundtruth::plan {
namespace {

/// What a segment separates; `more` is to the left of its direction from left to right.
struct EdgeData {
    Covers more;
    bool fence;
};

struct Sum {
    EdgeData operator()(const EdgeData& a, const EdgeData& b) const {
        return {{a.more.first + b.more.first, a.more.second + b.more.second}, a.fence || b.fence};
    }
};

struct FaceData {
    Covers covers;
    bool counted = false;
    bool inside = false;
    int part = -1; // number of the connected set of inside faces
};

using Traits = CGAL::Arr_curve_data_traits_2<CGAL::Arr_segment_traits_2<ExactKernel>, EdgeData, Sum>;
using Dcel = CGAL::Arr_extended_dcel<Traits, char, bool, FaceData>; // of halfedges: already part of a ring
using Arrangement = CGAL::Arrangement_2<Traits, Dcel>;
using Halfedge = Arrangement::Halfedge_handle;
using Face = Arrangement::Face_handle;

Traits::Curve_2 curveOf(const CoverEdge& edge) {
    const bool rightwards = edge.from < edge.to;
    const Covers more = rightwards ? edge.more : Covers{-edge.more.first, -edge.more.second};
    return {CGAL::Arr_segment_traits_2<ExactKernel>::Curve_2(edge.from, edge.to), EdgeData{more, edge.fence}};
}

Covers across(const Arrangement::Halfedge& h) {
    const Covers left = h.face()->data().covers, more = h.curve().data().more;
    const int sign = h.direction() == CGAL::ARR_LEFT_TO_RIGHT ? 1 : -1;
    return {left.first - sign * more.first, left.second - sign * more.second};
}

template <typename Visit>
void forEachHalfedge(Face face, const Visit& visit) {
    const auto around = [&](Arrangement::Ccb_halfedge_circulator first) {
        Arrangement::Ccb_halfedge_circulator h = first;
        do visit(Halfedge(h));
        while (++h != first);
    };
    for (auto ccb = face->outer_ccbs_begin(); ccb != face->outer_ccbs_end(); ++ccb) around(*ccb);
    for (auto ccb = face->inner_ccbs_begin(); ccb != face->inner_ccbs_end(); ++ccb) around(*ccb);
}

/// Breadth first over the faces from `start`: `enter(halfedge)` decides whether to go to the twin's face, and marks it.
template <typename Enter>
void spread(Face start, const Enter& enter) {
    std::vector<Face> reached{start};
    for (std::size_t i = 0; i < reached.size(); ++i)
        forEachHalfedge(reached[i], [&](Halfedge h) {
            if (enter(h)) reached.push_back(h->twin()->face());
        });
}

bool onBorder(const Arrangement::Halfedge& h) { return h.face()->data().inside && !h.twin()->face()->data().inside; }

/// The border that begins with `start`, the inside to its left: at each vertex on to the next border edge of the same wedge.
ExactRing borderFrom(Halfedge start) {
    ExactRing ring;
    Halfedge h = start;
    do {
        h->set_data(true);
        ring.push_back(h->source()->point());
        h = h->next();
        while (!onBorder(*h)) h = h->twin()->next();
    } while (h != start);
    return ring;
}

/// Cuts a border that comes back to a vertex into rings that do not.
std::vector<ExactRing> simpleRings(const ExactRing& border) {
    std::vector<ExactRing> rings;
    ExactRing path;
    std::map<ExactPoint, std::size_t> place; // in the path
    for (const ExactPoint& point : border) {
        if (const auto found = place.find(point); found != place.end()) {
            const auto from = path.begin() + static_cast<std::ptrdiff_t>(found->second);
            rings.emplace_back(from, path.end());
            for (const ExactPoint& gone : rings.back()) place.erase(gone);
            path.erase(from, path.end());
        }
        place.emplace(point, path.size());
        path.push_back(point);
    }
    rings.push_back(std::move(path));
    return rings;
}

/// Without the points at which the ring goes straight on; begins at its least point.
ExactRing tidy(const ExactRing& ring) {
    ExactRing result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const ExactPoint &before = ring[(i + ring.size() - 1) % ring.size()], &after = ring[(i + 1) % ring.size()];
        if (!CGAL::collinear(before, ring[i], after)) result.push_back(ring[i]);
    }
    std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
    return result;
}

/// Of a ring that begins at its least point, which is a corner.
bool counterClockwise(const ExactRing& ring) { return CGAL::left_turn(ring.back(), ring[0], ring[1]); }

bool leastPointFirst(const ExactRing& a, const ExactRing& b) {
    if (a[0] != b[0]) return a[0] < b[0];
    return CGAL::left_turn(b[0], b[1], a[1]); // rings that touch in their least points
}

/// Joins inside faces that share an edge into parts; returns how many there are.
int numberParts(Arrangement& plane) {
    int parts = 0;
    for (Face face = plane.faces_begin(); face != plane.faces_end(); ++face) {
        if (!face->data().inside || face->data().part >= 0) continue;
        face->data().part = parts;
        spread(face, [&](Halfedge h) {
            FaceData& other = h->twin()->face()->data();
            if (!other.inside || other.part >= 0) return false;
            other.part = parts;
            return true;
        });
        ++parts;
    }
    return parts;
}

/// Counts from a face on. Throws InternalError if two ways to a face disagree.
void count(Face start, Covers covers) {
    start->data().covers = covers;
    start->data().counted = true;
    spread(start, [](Halfedge h) {
        if (h->curve().data().fence) return false;
        FaceData& other = h->twin()->face()->data();
        const Covers expected = across(*h);
        if (other.counted && (other.covers.first != expected.first || other.covers.second != expected.second))
            throw InternalError("The edges of a shadow do not close: two ways to a face of their arrangement give different "
                                "winding numbers; please report this scene.");
        other.covers = expected;
        return !std::exchange(other.counted, true);
    });
}

/// The face that holds a point; nothing if it lies on an edge.
std::optional<Face> faceAt(Arrangement& plane, const ExactPoint& point) {
    const auto found = CGAL::Arr_naive_point_location<Arrangement>(plane).locate(point);
    if (const auto* face = boost::get<Arrangement::Face_const_handle>(&found)) return plane.non_const_handle(*face);
    return std::nullopt;
}

/// Interval arithmetic over the trapezoids of a ring's edges, seen from `origin`.
CGAL::Interval_nt<> twiceArea(const ExactRing& ring, const ExactPoint& origin) {
    CGAL::Interval_nt<> sum(0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const ExactKernel::Vector_2 a = ring[i] - origin, b = ring[(i + 1) % ring.size()] - origin;
        sum += CGAL::Interval_nt<>(CGAL::to_interval(a.x() * b.y() - a.y() * b.x()));
    }
    return sum;
}

} // namespace

struct CoveredPlane::Faces {
    Arrangement plane;
};

CoveredPlane::CoveredPlane(const std::vector<CoverEdge>& edges) : faces_(std::make_unique<Faces>()) {
    std::vector<Traits::Curve_2> curves;
    curves.reserve(edges.size());
    for (const CoverEdge& edge : edges)
        if (edge.from != edge.to) curves.push_back(curveOf(edge));
    CGAL::insert(faces_->plane, curves.begin(), curves.end());
}

CoveredPlane::~CoveredPlane() = default;

void CoveredPlane::countFromOutside() { count(faces_->plane.unbounded_face(), {}); }

bool CoveredPlane::countFrom(const ExactPoint& point, Covers covers) {
    const std::optional<Face> face = faceAt(faces_->plane, point);
    if (face) count(*face, covers);
    return face.has_value();
}

std::vector<std::optional<Covers>> CoveredPlane::at(const std::vector<ExactPoint>& points) const {
    using Found = std::pair<ExactPoint, CGAL::Arr_point_location_result<Arrangement>::Type>;
    std::vector<Found> found; // in the order of the points, equal ones once
    CGAL::locate(faces_->plane, points.begin(), points.end(), std::back_inserter(found));
    std::vector<std::optional<Covers>> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto place = std::ranges::lower_bound(found, points[i], {}, &Found::first);
        if (const auto* face = boost::get<Arrangement::Face_const_handle>(&place->second))
            result[i] = (*face)->data().covers;
    }
    return result;
}

std::optional<ExactRing> CoveredPlane::visibleFrom(const ExactPoint& point) const {
    const std::optional<Face> face = faceAt(faces_->plane, point);
    if (!face) return std::nullopt;
    CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<ExactKernel>> seen;
    const CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true> visibility(faces_->plane);
    const auto first = visibility.compute_visibility(point, *face, seen)->outer_ccb();
    ExactRing ring;
    auto h = first;
    do ring.push_back(h->source()->point());
    while (++h != first);
    return ring;
}

ExactRegion CoveredPlane::where(const std::function<bool(Covers)>& inside) const {
    Arrangement& plane = faces_->plane;
    for (Face face = plane.faces_begin(); face != plane.faces_end(); ++face) {
        face->data().inside = face->data().counted && inside(face->data().covers);
        face->data().part = -1;
    }
    for (Halfedge h = plane.halfedges_begin(); h != plane.halfedges_end(); ++h) h->set_data(false);

    std::vector<ExactPolygon> polygons(static_cast<std::size_t>(numberParts(plane)));
    for (Halfedge h = plane.halfedges_begin(); h != plane.halfedges_end(); ++h) {
        if (h->data() || !onBorder(*h)) continue;
        ExactPolygon& polygon = polygons[static_cast<std::size_t>(h->face()->data().part)];
        for (const ExactRing& ring : simpleRings(borderFrom(h))) {
            const ExactRing tidied = tidy(ring);
            if (!counterClockwise(tidied))
                polygon.holes.push_back(tidied);
            else if (!std::exchange(polygon.outer, tidied).empty())
                throw InternalError("A connected part of a shadow has two outer borders; please report this scene.");
        }
    }
    for (ExactPolygon& polygon : polygons) std::ranges::sort(polygon.holes, leastPointFirst);
    std::ranges::sort(polygons, leastPointFirst, &ExactPolygon::outer);
    return {std::move(polygons)};
}

void addBorder(const ExactRegion& region, Covers inside, std::vector<CoverEdge>& edges) {
    const auto add = [&](const ExactRing& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()], inside});
    };
    for (const ExactPolygon& polygon : region.polygons) {
        add(polygon.outer);
        for (const ExactRing& hole : polygon.holes) add(hole);
    }
}

std::vector<Location> locate(const ExactRegion& region, const std::vector<ExactPoint>& points) {
    std::vector<CoverEdge> edges;
    addBorder(region, {1, 0}, edges);
    CoveredPlane plane(edges);
    plane.countFromOutside();
    std::vector<Location> result;
    for (const std::optional<Covers>& covers : plane.at(points))
        result.push_back(!covers ? Location::OnBorder : covers->first > 0 ? Location::Inside : Location::Outside);
    return result;
}

double areaOf(const ExactRegion& region) {
    CGAL::Interval_nt<> sum(0);
    for (const ExactPolygon& polygon : region.polygons) {
        sum += twiceArea(polygon.outer, polygon.outer[0]);
        for (const ExactRing& hole : polygon.holes) sum += twiceArea(hole, polygon.outer[0]);
    }
    const double area = 0.25 * (sum.inf() + sum.sup());
    return region.polygons.empty() ? 0 : std::max(area, std::numeric_limits<double>::min());
}

} // namespace shadowbench::groundtruth::plan
