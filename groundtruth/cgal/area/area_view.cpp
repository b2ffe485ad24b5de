#include "groundtruth/cgal/area/area_view.h"

#include "groundtruth/cgal/area/area_double_double.h"
#include "groundtruth/cgal/area/area_light_map.h"
#include "groundtruth/cgal/area/area_rough.h"
#include "groundtruth/cgal/geometry/arithmetic.h"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

namespace shadowbench::groundtruth::area {
namespace {

using Rational = CGAL::Exact_rational;

Interval toInterval(const Interval& value) { return value; }

Interval toInterval(const Rational& value) {
    const std::pair<double, double> bounds = CGAL_NTS to_interval(value);
    return {bounds.first, bounds.second};
}

Interval toInterval(const DoubleDouble& value) {
    const double slack = (std::abs(value.low) + value.error) * (1 + 0x1p-40);
    if (slack == 0) return value.high;
    return {std::nextafter(value.high - slack, -INFINITY), std::nextafter(value.high + slack, INFINITY)};
}

using geometry::signOf;

/// As those of groundtruth/cgal/geometry/arithmetic.h.
int signOf(const DoubleDouble& value) {
    const double least = std::abs(value.high) * (1 - 0x1p-40);
    if (!(least > value.error) && !(value.high == 0 && value.error == 0))
        throw CGAL::Uncertain_conversion_exception("the sign of a double-double number is open");
    return value.high > 0 ? 1 : value.high < 0 ? -1 : 0;
}

LightMap<Interval> intervalMap(const ReceiverPoint& point, const ReceiverPoint::Remainder& rest, const Light& light,
                               int sense) {
    return {vector<Interval>(point.rounded()),
            {Interval(rest.low.x, rest.high.x), Interval(rest.low.y, rest.high.y), Interval(rest.low.z, rest.high.z)},
            light,
            sense};
}

/// In rational or double-double numbers.
template <typename Number>
LightMap<Number> mapFrom(const SurfacePoint& point, const Light& light, int sense) {
    const Vector<Number> corner = vector<Number>(point.receiver[0]), across = normal<Number>(point.receiver);
    const Vector<Number> origin = vector<Number>(point.ray.origin), direction = vector<Number>(point.ray.direction);
    const Number depth = dot(across, corner - origin) / dot(across, direction);
    return {origin + depth * direction, vector<Number>(glm::dvec3(0)), light, sense};
}

/// A vertex of something clipped. On the window's borders its coordinates are known: column or row −1 or 1.
template <typename Number>
struct Corner {
    Vector<Number> at;
    int column = 0, row = 0;
    int end = -1; // 0 or 1 if this is an end of the edge that is clipped
};

template <typename Number>
Corner<Number> between(const Corner<Number>& a, const Corner<Number>& b, const Number& share) {
    return {a.at + share * (b.at - a.at), a.column == b.column ? a.column : 0, a.row == b.row ? a.row : 0};
}

/// The exact view of the light's plane from one point, in intervals and, made when first needed, in double-double and in
/// rational numbers.
class View {
public:
    View(const Light& light, const SurfacePoint& point, const ReceiverPoint& receiver)
        : light_(light), point_(point), rest_(receiver.remainder()), sense_(senseOf(receiver)) {
        if (sense_ == 0) return;
        const Interval::Protector rounding;
        intervals_.emplace(intervalMap(receiver, rest_, light_, sense_));
    }

    /// 1 if u × v points away from the surface point, −1 if towards it, 0 if the point lies in the light's plane.
    [[nodiscard]] int sense() const { return sense_; }

    /// Runs `construct(map)` in intervals, again in double-double numbers and at last in rational ones, where those before
    /// leave a decision open or yield a result for which `tooWide` holds.
    template <typename Construct, typename TooWide>
    auto filtered(const Construct& construct, const TooWide& tooWide) {
        try {
            const Interval::Protector rounding;
            auto result = construct(*intervals_);
            if (!tooWide(result)) return result;
        } catch (const CGAL::Uncertain_conversion_exception&) {
            // decided below
        }
        try {
            if (!doubleDoubles_) doubleDoubles_.emplace(mapFrom<DoubleDouble>(point_, light_, sense_));
            auto result = construct(*doubleDoubles_);
            if (!tooWide(result)) return result;
        } catch (const CGAL::Uncertain_conversion_exception&) {
            // decided below
        }
        if (!rationals_) rationals_.emplace(mapFrom<Rational>(point_, light_, sense_));
        return construct(*rationals_);
    }

private:
    [[nodiscard]] int senseOf(const ReceiverPoint& receiver) const {
        try {
            const Interval::Protector rounding;
            return signOf(intervalMap(receiver, rest_, light_, 1).distance);
        } catch (const CGAL::Uncertain_conversion_exception&) {
            return signOf(mapFrom<Rational>(point_, light_, 1).distance);
        }
    }

    const Light& light_;
    const SurfacePoint& point_;
    ReceiverPoint::Remainder rest_;
    int sense_;
    std::optional<LightMap<Interval>> intervals_;
    std::optional<LightMap<DoubleDouble>> doubleDoubles_;
    std::optional<LightMap<Rational>> rationals_;
};

/// Clips at value ≥ 0; `mark` notes on a new corner on which border it lies. `open`: two corners are a segment, not a
/// polygon.
template <typename Number, typename Value, typename Mark>
std::vector<Corner<Number>> clip(const std::vector<Corner<Number>>& corners, bool open, const Value& value,
                                 const Mark& mark) {
    std::vector<Corner<Number>> result;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Corner<Number>& a = corners[i];
        const Number va = value(a.at);
        const int sa = signOf(va);
        if (sa >= 0) result.push_back(a);
        if (sa == 0) mark(result.back());
        if (open && i + 1 == count) break;
        const Corner<Number>& b = corners[(i + 1) % count];
        const Number vb = value(b.at);
        if (sa * signOf(vb) >= 0) continue;
        Corner<Number> corner = between(a, b, Number(va / (va - vb)));
        mark(corner);
        result.push_back(corner);
    }
    return result;
}

template <typename Number>
std::vector<Corner<Number>> clipColumns(std::vector<Corner<Number>> corners, bool open, const Number& window) {
    corners = clip(
        corners, open, [&](const auto& p) { return Number(window * p.z + p.x); }, [](auto& corner) { corner.column = -1; });
    return clip(
        corners, open, [&](const auto& p) { return Number(window * p.z - p.x); }, [](auto& corner) { corner.column = 1; });
}

template <typename Number>
std::vector<Corner<Number>> clipRows(std::vector<Corner<Number>> corners, bool open, const Number& window) {
    corners = clip(
        corners, open, [&](const auto& p) { return Number(window * p.z + p.y); }, [](auto& corner) { corner.row = -1; });
    return clip(
        corners, open, [&](const auto& p) { return Number(window * p.z - p.y); }, [](auto& corner) { corner.row = 1; });
}

/// Nothing if no corner lies strictly before the light's plane.
template <typename Number>
std::vector<Corner<Number>> clipAtLight(const std::vector<Corner<Number>>& corners, bool open, const Number& distance) {
    const auto depth = [&](const auto& p) { return Number(distance - p.z); };
    if (std::ranges::none_of(corners, [&](const auto& corner) { return signOf(depth(corner.at)) > 0; })) return {};
    return clip(corners, open, depth, [](auto&) {});
}

/// A coordinate in doubles with its error; border: −1, 1 or 0 for the quotient.
struct Coordinate {
    double value, error;
};
template <typename Number>
Coordinate coordinate(const Number& numerator, const Number& weight, int border, double window) {
    if (border != 0) return {border * window, 0};
    const Interval q = toInterval(Number(numerator / weight));
    return {0.5 * (q.inf() + q.sup()), q.sup() - q.inf()};
}

template <typename Number>
CoverEdge coverEdge(const Corner<Number>& a, const Corner<Number>& b, int covers, double window) {
    const Coordinate ax = coordinate(a.at.x, a.at.z, a.column, window), ay = coordinate(a.at.y, a.at.z, a.row, window);
    const Coordinate bx = coordinate(b.at.x, b.at.z, b.column, window), by = coordinate(b.at.y, b.at.z, b.row, window);
    return {{ax.value, ay.value},
            {bx.value, by.value},
            covers,
            std::max(std::max(ax.error, ay.error), std::max(bx.error, by.error))};
}

/// A cover edge and which ends of the mesh's edge it still has.
struct ClippedEdge {
    CoverEdge edge;
    int fromEnd = -1, toEnd = -1;
};

/// Edges of one construction: a clipped triangle has at most eight.
using ClippedEdges = std::vector<ClippedEdge>;

/// An edge's error is judged by the area that it sweeps.
bool exceeds(const ClippedEdges& edges, double tolerance) {
    return std::ranges::any_of(edges, [&](const ClippedEdge& clipped) {
        const CoverEdge& e = clipped.edge;
        return !(e.error * (glm::distance(e.from, e.to) + e.error) <= tolerance);
    });
}

template <typename Number>
void addEdge(const Corner<Number>& a, const Corner<Number>& b, int covers, double window, ClippedEdges& edges) {
    const bool alongRow = a.row != 0 && a.row == b.row; // bounds no row of the window
    if (alongRow) return;
    edges.push_back({coverEdge(a, b, covers, window), a.row == 0 ? a.end : -1, b.row == 0 ? b.end : -1});
}

/// The part of an edge with w > 0 that lies in the window's rows; what is left of the window moves onto its left border, and
/// what is right of it bounds nothing inside.
template <typename Number>
ClippedEdges clippedEdge(const Vector<Number>& a, const Vector<Number>& b, int covers, double window) {
    const Number border(window);
    std::vector<Corner<Number>> edge = clipRows<Number>({{a, 0, 0, 0}, {b, 0, 0, 1}}, true, border);
    edge = clip(
        edge, true, [&](const auto& p) { return Number(border * p.z - p.x); }, [](auto& corner) { corner.column = 1; });
    if (edge.size() < 2) return {};

    const auto leftSide = [&](const Corner<Number>& c) { return signOf(Number(border * c.at.z + c.at.x)); };
    const auto moved = [](Corner<Number> c) {
        c.column = -1;
        return c;
    };
    const int from = leftSide(edge[0]), to = leftSide(edge[1]);
    ClippedEdges result;
    if (from >= 0 && to >= 0) {
        addEdge(edge[0], edge[1], covers, window, result);
    } else if (from <= 0 && to <= 0) {
        addEdge(moved(edge[0]), moved(edge[1]), covers, window, result);
    } else {
        const std::vector<Corner<Number>> right = clip(
            edge, true, [&](const auto& p) { return Number(border * p.z + p.x); }, [](auto& corner) { corner.column = -1; });
        const Corner<Number>& crossing = from < 0 ? right.front() : right.back();
        addEdge(from < 0 ? moved(edge[0]) : edge[0], crossing, covers, window, result);
        addEdge(crossing, to < 0 ? moved(edge[1]) : edge[1], covers, window, result);
    }
    return result;
}

/// The border of the part of a triangle that is seen in the window and lies before the light's plane.
template <typename Number>
ClippedEdges clippedTriangle(const LightMap<Number>& map, const Triangle& t, int covers, double window) {
    std::vector<Corner<Number>> corners{{map(t[0])}, {map(t[1])}, {map(t[2])}};
    corners = clipAtLight(corners, false, map.distance);
    if (corners.size() < 3) return {};
    const Number border(window);
    corners = clipRows(clipColumns(std::move(corners), false, border), false, border);
    ClippedEdges result;
    if (corners.size() < 3) return result;
    for (std::size_t i = 0; i < corners.size(); ++i)
        addEdge(corners[i], corners[(i + 1) % corners.size()], covers, window, result);
    return result;
}

/// Collects the cover edges of all triangles, instance by instance.
class EdgeCollector {
public:
    EdgeCollector(const SceneTriangles& scene, View& view, const RoughMap& rough, const ReceiverPoint& point,
                  double tolerance)
        : scene_(scene), view_(view), rough_(rough), point_(point), tolerance_(tolerance) {}

    void add(TriangleName name, const Triangle& triangle) {
        if (name.instance != instance_) flush();
        instance_ = name.instance;
        const std::array<Vector<double>, 3> seen{rough_(triangle[0]), rough_(triangle[1]), rough_(triangle[2])};
        if (rough_.misses(seen, false)) return;
        const int covers = -side(triangle, point_) * view_.sense(); // 1 if it turns left in light coordinates
        if (covers == 0) return;
        if (rough_.between(seen))
            addToChain(name, covers);
        else
            for (const ClippedEdge& clipped :
                 filtered([&](const auto& map) { return clippedTriangle(map, triangle, covers, rough_.window()); }))
                edges_.push_back(clipped.edge);
    }

    std::vector<CoverEdge> finish() {
        flush();
        return std::move(edges_);
    }

private:
    /// A directed edge of a triangle: its lower and higher vertex, and whether it leads from the higher to the lower.
    static std::uint64_t key(std::uint32_t from, std::uint32_t to) {
        const std::uint64_t low = std::min(from, to), high = std::max(from, to);
        return low << 33U | high << 1U | (from > to ? 1U : 0U);
    }

    void addToChain(TriangleName name, int covers) {
        glm::uvec3 t = scene_.instances()[name.instance].mesh->triangles[name.triangle];
        if (covers < 0) std::swap(t.y, t.z);
        chain_.insert(chain_.end(), {key(t.x, t.y), key(t.y, t.z), key(t.z, t.x)});
    }

    /// Sums the directions of every edge and keeps what does not cancel.
    void flush() {
        std::ranges::sort(chain_);
        for (std::size_t i = 0; i < chain_.size();) {
            const std::uint64_t edge = chain_[i] >> 1U;
            int covers = 0;
            for (; i < chain_.size() && chain_[i] >> 1U == edge; ++i) covers += (chain_[i] & 1U) == 0 ? 1 : -1;
            if (covers != 0) addChainEdge(static_cast<std::uint32_t>(edge >> 32U), static_cast<std::uint32_t>(edge), covers);
        }
        chain_.clear();
    }

    void addChainEdge(std::uint32_t from, std::uint32_t to, int covers) {
        const TriangleInstance& instance = scene_.instances()[instance_];
        const glm::dvec3 a = worldVertex(instance.world, instance.mesh->positions[from]);
        const glm::dvec3 b = worldVertex(instance.world, instance.mesh->positions[to]);
        const ClippedEdges found =
            filtered([&](const auto& map) { return clippedEdge(map(a), map(b), covers, rough_.window()); });
        for (ClippedEdge clipped : found) {
            if (clipped.fromEnd >= 0) moveToRowOf(clipped.fromEnd == 0 ? a : b, clipped.edge.from, clipped.edge);
            if (clipped.toEnd >= 0) moveToRowOf(clipped.toEnd == 0 ? a : b, clipped.edge.to, clipped.edge);
            edges_.push_back(clipped.edge);
        }
    }

    /// Edges that share a vertex must meet in one row, however each was computed: between two rows the winding would be
    /// wrong across the whole window.
    void moveToRowOf(const glm::dvec3& vertex, glm::dvec2& end, CoverEdge& edge) {
        const Coordinate row = view_.filtered(
            [&](const auto& map) {
                const auto p = map(vertex);
                return coordinate(p.y, p.z, 0, rough_.window());
            },
            [&](const Coordinate& c) { return !(c.error <= tolerance_); });
        end.y = row.value;
        edge.error = std::max(edge.error, row.error);
    }

    template <typename Construct>
    ClippedEdges filtered(const Construct& construct) {
        return view_.filtered(construct, [&](const ClippedEdges& e) { return exceeds(e, tolerance_); });
    }

    const SceneTriangles& scene_;
    View& view_;
    const RoughMap& rough_;
    const ReceiverPoint& point_;
    double tolerance_;
    std::uint32_t instance_ = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint64_t> chain_;
    std::vector<CoverEdge> edges_;
};

/// The part of a line light that a triangle hides, by where it meets the plane y = 0 of point and light. A corner in that
/// plane counts as above it.
template <typename Number>
std::optional<CoverInterval> hiddenPart(const LightMap<Number>& map, const Triangle& t, double window) {
    const std::array<Vector<Number>, 3> corners{map(t[0]), map(t[1]), map(t[2])};
    std::vector<Corner<Number>> segment;
    for (int i = 0; i < 3; ++i) {
        const Vector<Number>&a = corners[i], &b = corners[(i + 1) % 3];
        if ((signOf(a.y) >= 0) == (signOf(b.y) >= 0)) continue;
        segment.push_back(between<Number>({a}, {b}, Number(a.y / (a.y - b.y))));
    }
    if (segment.empty()) return std::nullopt;
    segment = clipAtLight(segment, true, map.distance);
    if (segment.size() < 2) return std::nullopt;
    segment = clipColumns(std::move(segment), true, Number(window));
    if (segment.size() < 2) return std::nullopt;
    const Coordinate a = coordinate(segment[0].at.x, segment[0].at.z, segment[0].column, window);
    const Coordinate b = coordinate(segment[1].at.x, segment[1].at.z, segment[1].column, window);
    return CoverInterval{std::min(a.value, b.value), std::max(a.value, b.value), std::max(a.error, b.error)};
}

/// A line light with a second side, the axis from which the point sees the plane through both at the widest angle, so that u
/// × v points away from the point.
Light widened(Light line, const glm::dvec3& point) {
    const glm::dvec3 moment = glm::cross(line.centre - point, line.u); // D·(u × v) = v·(D × u)
    const glm::dvec3 size = glm::abs(moment);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    line.v = glm::dvec3(0);
    line.v[axis] = moment[axis] < 0 ? -1 : 1;
    return line;
}

} // namespace

std::optional<std::vector<CoverEdge>> coverEdges(const SceneTriangles& scene, const Light& light, const SurfacePoint& point,
                                                 double tolerance) {
    const ReceiverPoint receiver(point.ray, point.receiver);
    View view(light, point, receiver);
    if (view.sense() == 0) return std::nullopt;
    const RoughMap rough(receiver, light, view.sense(), scene.reachFrom(receiver.rounded()));
    EdgeCollector collector(scene, view, rough, receiver, tolerance);
    scene.visitShaft(rough.shaft(false), [&](TriangleName name) { collector.add(name, scene.triangle(name)); });
    return collector.finish();
}

std::optional<std::vector<CoverInterval>> coverIntervals(const SceneTriangles& scene, const Light& line,
                                                         const SurfacePoint& point, double tolerance) {
    const ReceiverPoint receiver(point.ray, point.receiver);
    const Light light = widened(line, receiver.rounded());
    View view(light, point, receiver);
    if (view.sense() == 0) return std::nullopt;
    const RoughMap rough(receiver, light, view.sense(), scene.reachFrom(receiver.rounded()));
    std::vector<CoverInterval> hidden;
    scene.visitShaft(rough.shaft(true), [&](TriangleName name) {
        const Triangle t = scene.triangle(name);
        if (rough.misses({rough(t[0]), rough(t[1]), rough(t[2])}, true) || side(t, receiver) == 0) return;
        const auto part = view.filtered([&](const auto& map) { return hiddenPart(map, t, rough.window()); },
                                        [&](const auto& found) { return found && !(found->error <= tolerance); });
        if (part) hidden.push_back(*part);
    });
    return hidden;
}

std::vector<Triangle> areaCandidates(const SceneTriangles& scene, const Light& light, const SurfacePoint& point) {
    const ReceiverPoint receiver(point.ray, point.receiver);
    const bool flat = light.kind == LightKind::Line;
    const Light shape = flat ? widened(light, receiver.rounded()) : light;
    const double towards = glm::dot(shape.centre - receiver.rounded(), glm::cross(shape.u, shape.v));
    const RoughMap rough(receiver, shape, towards < 0 ? -1 : 1, scene.reachFrom(receiver.rounded()));
    std::vector<Triangle> result;
    scene.visitShaft(rough.shaft(flat), [&](TriangleName name) { result.push_back(scene.triangle(name)); });
    return result;
}

} // namespace shadowbench::groundtruth::area
