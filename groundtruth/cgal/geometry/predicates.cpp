#include "groundtruth/cgal/geometry/predicates.h"

#include "groundtruth/cgal/geometry/arithmetic.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace shadowbench::groundtruth::geometry {
namespace {

/// Numerator and denominator of the parameter at which a ray meets a triangle's plane.
template <typename Number>
std::pair<Number, Number> depthFraction(const Ray& ray, const Triangle& triangle) {
    const Vector<Number> n = normal<Number>(triangle);
    return {dot(n, vector<Number>(triangle[0]) - vector<Number>(ray.origin)), dot(n, vector<Number>(ray.direction))};
}

DepthBounds depthBounds(const Ray& ray, const Triangle& triangle) {
    {
        const Interval::Protector rounding;
        const auto [numerator, denominator] = depthFraction<Interval>(ray, triangle);
        if (denominator.inf() > 0 || denominator.sup() < 0) {
            const Interval t = numerator / denominator;
            return {t.inf(), t.sup()};
        }
    }
    const auto [numerator, denominator] = depthFraction<Ring>(ray, triangle);
    const std::pair<double, double> n = CGAL_NTS to_interval(numerator), d = CGAL_NTS to_interval(denominator);
    const Interval::Protector rounding;
    const Interval t = Interval(n.first, n.second) / Interval(d.first, d.second);
    return {t.inf(), t.sup()};
}

/// u × v in rounded arithmetic, and with every term positive.
struct RoundedCross {
    RoundedCross(const glm::dvec3& u, const glm::dvec3& v) {
        const glm::dvec3 plus(u.y * v.z, u.z * v.x, u.x * v.y), minus(u.z * v.y, u.x * v.z, u.y * v.x);
        value = plus - minus;
        magnitude = glm::abs(plus) + glm::abs(minus);
    }
    glm::dvec3 value, magnitude;
};

int roundedSign(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& p) {
    const RoundedCross n(u, v);
    return certainSign(glm::dot(n.value, p), glm::dot(n.magnitude, glm::abs(p)));
}

/// Side of the plane in rounded arithmetic; 0 where rounding could have changed it.
int roundedSide(const Triangle& t, const glm::dvec4& point) {
    return roundedSign(t[1] - t[0], t[2] - t[0], point.w == 0 ? glm::dvec3(point) : glm::dvec3(point) - t[0]);
}

int roundedSide(const Triangle& t, const ReceiverPoint& point) {
    const RoundedCross n(t[1] - t[0], t[2] - t[0]);
    const glm::dvec3 p = point.near() - t[0];
    // As the point moves by the error, the determinant does by the normal times that.
    return certainSign(glm::dot(n.value, p), glm::dot(n.magnitude, glm::abs(p)), glm::dot(n.magnitude, point.nearError()));
}

/// Side on which the ray passes the directed edge from a to b.
int passes(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b) {
    if (const int sign = roundedSign(a - ray.origin, b - ray.origin, ray.direction)) return sign;
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const Vector<Number> origin = vector<Number>(ray.origin);
        return dot(vector<Number>(ray.direction), cross(vector<Number>(a) - origin, vector<Number>(b) - origin));
    });
}

bool meets(const Ray& ray, const Triangle& t) {
    const int s0 = passes(ray, t[0], t[1]);
    const int s1 = passes(ray, t[1], t[2]);
    if (s0 * s1 < 0) return false;
    const int s2 = passes(ray, t[2], t[0]);
    if (s0 * s2 < 0 || s1 * s2 < 0) return false;
    return s0 != 0 || s1 != 0 || s2 != 0; // all zero: the triangle is seen edge-on
}

/// From the point along the segment to the light, in rounded arithmetic.
glm::dvec3 roundedAxis(const ReceiverPoint& point, const glm::dvec4& light) {
    return light.w == 0 ? glm::dvec3(light) : glm::dvec3(light) - point.near();
}

/// `turn` from x to y in rounded arithmetic; 0 where rounding could have changed it. `u` and `v` are x and y minus the
/// point.
int roundedTurn(const ReceiverPoint& point, const glm::dvec3& axis, const glm::dvec3& u, const glm::dvec3& v) {
    const RoundedCross n(u, v);
    // As the point moves by δ, the determinant does by δ · (u × v + v × axis + axis × u), of a direction without the first.
    const glm::dvec3 a = glm::abs(axis), sum = glm::abs(u) + glm::abs(v);
    const glm::dvec3 others(a.y * sum.z + a.z * sum.y, a.z * sum.x + a.x * sum.z, a.x * sum.y + a.y * sum.x);
    return certainSign(glm::dot(axis, n.value), glm::dot(a, n.magnitude), glm::dot(point.nearError(), others + n.magnitude));
}

int exactTurn(const ReceiverPoint& point, const glm::dvec4& light, const glm::dvec3& x, const glm::dvec3& y) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto& p = homogeneous(point, tag);
        const Vector<Number> l = vector<Number>(glm::dvec3(light));
        const Vector<Number> axis = light.w == 0 ? l : p.w * l - p.xyz;
        return dot(axis, cross(p.w * vector<Number>(x) - p.xyz, p.w * vector<Number>(y) - p.xyz));
    });
}

/// Seen from the point along the segment to the light: 1 if y lies to the left of x, as the orientation of (point, light, x,
/// y).
int turn(const ReceiverPoint& point, const glm::dvec4& light, const glm::dvec3& x, const glm::dvec3& y) {
    if (const int sign = roundedTurn(point, roundedAxis(point, light), x - point.near(), y - point.near())) return sign;
    return exactTurn(point, light, x, y);
}

/// The part of the view along a segment that a touching triangle covers next to it: from `start` to the left up to `end`,
/// less than half a turn. Directions are named by points: the one from the segment towards that point.
struct Sector {
    glm::dvec3 start, end;
};

/// One sector if the segment passes through a corner, two if it passes through an edge (split at the opposite corner).
void addSectors(const ReceiverPoint& point, const glm::dvec4& light, Triangle t, std::vector<Sector>& sectors) {
    std::array<int, 3> turns{};
    for (int i = 0; i < 3; ++i) turns[i] = turn(point, light, t[i], t[(i + 1) % 3]);
    if (std::ranges::any_of(turns, [](int s) { return s < 0; })) { // make it turn left
        std::swap(t[1], t[2]);
        turns = {-turns[2], -turns[1], -turns[0]};
    }
    for (int i = 0; i < 3; ++i)
        if (turns[i] > 0) sectors.push_back({t[i], t[(i + 1) % 3]});
}

} // namespace

std::optional<DepthBounds> crossing(const Ray& ray, const Triangle& triangle) {
    if (!meets(ray, triangle)) return std::nullopt;
    return depthBounds(ray, triangle);
}

int compareDepth(const Ray& ray, const Triangle& a, const Triangle& b) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto [an, ad] = depthFraction<Number>(ray, a);
        const auto [bn, bd] = depthFraction<Number>(ray, b);
        return Number((an * bd - bn * ad) * ad * bd);
    });
}

int compareDepth(const Ray& ray, const Triangle& triangle, double t) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto [numerator, denominator] = depthFraction<Number>(ray, triangle);
        return Number((numerator - Number(t) * denominator) * denominator);
    });
}

int side(const Triangle& triangle, const glm::dvec4& point) {
    if (const int sign = roundedSide(triangle, point)) return sign;
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const Vector<Number> p = vector<Number>(glm::dvec3(point));
        return dot(normal<Number>(triangle), point.w == 0 ? p : p - vector<Number>(triangle[0]));
    });
}

int belowLight(const Triangle& plane, const glm::dvec4& light, const glm::dvec3& vertex) {
    if (light.w == 0) return 1;
    const glm::dvec3 level(light);
    int sign = roundedSign(plane[1] - plane[0], plane[2] - plane[0], level - vertex);
    if (sign == 0)
        sign = filteredSign([&](auto tag) {
            using Number = typename decltype(tag)::type;
            return dot(normal<Number>(plane), vector<Number>(level) - vector<Number>(vertex));
        });
    return sign * side(plane, light);
}

Triangle facing(Triangle triangle, const glm::dvec4& light) {
    if (side(triangle, light) < 0) std::swap(triangle[1], triangle[2]);
    return triangle;
}

ReceiverPoint::ReceiverPoint(const Ray& ray, const Triangle& triangle) : ray_(ray), triangle_(triangle) {
    if (roundNear()) return;
    near_ = rounded();
    nearError_ = high() - low();
}

ReceiverPoint::~ReceiverPoint() = default;

bool ReceiverPoint::roundNear() {
    const RoundedCross n(triangle_[1] - triangle_[0], triangle_[2] - triangle_[0]);
    const glm::dvec3 &origin = ray_.origin, &direction = ray_.direction;
    const glm::dvec3 way = triangle_[0] - origin;
    const double numerator = glm::dot(n.value, way), denominator = glm::dot(n.value, direction);
    const double numeratorError = determinantError * glm::dot(n.magnitude, glm::abs(way));
    const double denominatorError = determinantError * glm::dot(n.magnitude, glm::abs(direction));
    constexpr double underflow = 1e-200;
    if (!(std::abs(denominator) > 2 * denominatorError && numeratorError > underflow && denominatorError > underflow))
        return false;
    const double depth = numerator / denominator;
    const double depthError =
        (numeratorError + std::abs(depth) * denominatorError) / (std::abs(denominator) - denominatorError) +
        0x1p-53 * std::abs(depth);
    near_ = origin + depth * direction;
    const glm::dvec3 rounding = 0x1p-52 * (glm::abs(origin) + 2 * std::abs(depth) * glm::abs(direction));
    nearError_ = sumsRoundedUp * (depthError * glm::abs(direction) + rounding);
    return std::isfinite(nearError_.x + nearError_.y + nearError_.z);
}

const ReceiverPoint::Bounds& ReceiverPoint::bounds() const {
    if (bounds_) return *bounds_;
    const CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST); // whatever it is while this is asked
    const DepthBounds t = depthBounds(ray_, triangle_);
    const Interval::Protector rounding;
    const Interval depth(t.low, t.high);
    bounds_.emplace();
    for (int axis = 0; axis < 3; ++axis) {
        const Interval x = Interval(ray_.origin[axis]) + depth * Interval(ray_.direction[axis]);
        bounds_->low[axis] = x.inf();
        bounds_->high[axis] = x.sup();
    }
    return *bounds_;
}

const ReceiverPoint::Exact& ReceiverPoint::exact() const {
    if (exact_) return *exact_;
    auto [numerator, denominator] = depthFraction<Ring>(ray_, triangle_);
    if (signOf(denominator) < 0) {
        numerator = -numerator;
        denominator = -denominator;
    }
    exact_ = std::make_unique<Exact>(
        Exact{{denominator * vector<Ring>(ray_.origin) + numerator * vector<Ring>(ray_.direction), denominator}});
    return *exact_;
}

ReceiverPoint::Remainder ReceiverPoint::remainder() const {
    const Homogeneous<Ring>& p = exact().point;
    const Vector<Ring> rest = p.xyz - p.w * vector<Ring>(rounded());
    const std::array<std::pair<double, double>, 4> bounds{CGAL_NTS to_interval(rest.x), CGAL_NTS to_interval(rest.y),
                                                          CGAL_NTS to_interval(rest.z), CGAL_NTS to_interval(p.w)};
    const Interval::Protector rounding;
    const Interval w(bounds[3].first, bounds[3].second);
    Remainder result{};
    for (int axis = 0; axis < 3; ++axis) {
        const Interval value = Interval(bounds[axis].first, bounds[axis].second) / w;
        result.low[axis] = value.inf();
        result.high[axis] = value.sup();
    }
    return result;
}

int side(const Triangle& triangle, const ReceiverPoint& point) {
    if (const int sign = roundedSide(triangle, point)) return sign;
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto& p = homogeneous(point, tag);
        return dot(normal<Number>(triangle), p.xyz - p.w * vector<Number>(triangle[0]));
    });
}

Blocking blocking(const ReceiverPoint& point, const glm::dvec4& light, const Triangle& t) {
    const glm::dvec3 axis = roundedAxis(point, light);
    const Triangle from{t[0] - point.near(), t[1] - point.near(), t[2] - point.near()};
    const auto turnBetween = [&](int x, int y) {
        const int sign = roundedTurn(point, axis, from[x], from[y]);
        return sign != 0 ? sign : exactTurn(point, light, t[x], t[y]);
    };
    const int s0 = turnBetween(0, 1);
    const int s1 = turnBetween(1, 2);
    if (s0 * s1 < 0) return Blocking::None;
    const int s2 = turnBetween(2, 0);
    if (s0 * s2 < 0 || s1 * s2 < 0) return Blocking::None;
    const int lightSide = side(t, light);
    if (lightSide == 0 || lightSide * side(t, point) >= 0) return Blocking::None;
    return s0 != 0 && s1 != 0 && s2 != 0 ? Blocking::Blocks : Blocking::Touches;
}

bool blockTogether(const ReceiverPoint& point, const glm::dvec4& light, std::span<const Triangle> touching) {
    std::vector<Sector> sectors;
    for (const Triangle& triangle : touching) addSectors(point, light, triangle, sectors);
    // A gap, if any, begins where some sector ends: all is covered if every end lies in another sector, its own end
    // excluded.
    const auto covered = [&](const glm::dvec3& direction) {
        return std::ranges::any_of(sectors, [&](const Sector& s) {
            return turn(point, light, s.start, direction) >= 0 && turn(point, light, direction, s.end) > 0;
        });
    };
    return !sectors.empty() && std::ranges::all_of(sectors, [&](const Sector& s) { return covered(s.end); });
}

} // namespace shadowbench::groundtruth::geometry
