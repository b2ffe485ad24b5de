#include "groundtruth/cgal/predicates.h"

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <type_traits>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

using Interval = CGAL::Interval_nt<false>;                      // rounding set by Interval::Protector
using Ring = CGAL::internal::Exact_ring_selector<double>::Type; // no division is needed anywhere

template <typename Number>
struct Vector {
    Number x, y, z;
};

template <typename Number>
Vector<Number> vector(const glm::dvec3& v) {
    return {Number(v.x), Number(v.y), Number(v.z)};
}

template <typename Number>
Vector<Number> operator-(const Vector<Number>& a, const Vector<Number>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <typename Number>
Vector<Number> operator*(const Number& s, const Vector<Number>& v) {
    return {s * v.x, s * v.y, s * v.z};
}

template <typename Number>
Vector<Number> operator+(const Vector<Number>& a, const Vector<Number>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <typename Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// (b − a) × (c − a).
template <typename Number>
Vector<Number> normal(const Triangle& t) {
    const Vector<Number> a = vector<Number>(t[0]);
    return cross(vector<Number>(t[1]) - a, vector<Number>(t[2]) - a);
}

CGAL::Uncertain<CGAL::Sign> signOf(const Interval& value) { return CGAL_NTS sign(value); }

int signOf(const Ring& value) { return static_cast<int>(CGAL_NTS sign(value)); }

/// The sign of `polynomial`, a function of the number type (as std::type_identity) to compute in.
template <typename Polynomial>
int filteredSign(const Polynomial& polynomial) {
    {
        const Interval::Protector rounding;
        const CGAL::Uncertain<CGAL::Sign> sign = signOf(polynomial(std::type_identity<Interval>()));
        if (CGAL::is_certain(sign)) return static_cast<int>(CGAL::get_certain(sign));
    }
    return signOf(polynomial(std::type_identity<Ring>()));
}

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

/// Side on which the ray passes the directed edge from a to b.
int passes(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b) {
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

} // namespace

/// The point (x, y, z) / w, w > 0.
struct ReceiverPoint::Exact {
    Vector<Ring> xyz;
    Ring w;
};

namespace {

/// A receiver point in homogeneous coordinates of either number type.
template <typename Number>
struct Homogeneous {
    Vector<Number> xyz;
    Number w;
};

Homogeneous<Interval> homogeneous(const ReceiverPoint& p, std::type_identity<Interval>) {
    return {{Interval(p.low().x, p.high().x), Interval(p.low().y, p.high().y), Interval(p.low().z, p.high().z)},
            Interval(1)};
}

Homogeneous<Ring> homogeneous(const ReceiverPoint& p, std::type_identity<Ring>) { return {p.exact().xyz, p.exact().w}; }

/// Seen from the point along the segment to the light: 1 if y lies to the left of x, as the orientation of (point, light, x,
/// y).
int turn(const ReceiverPoint& point, const glm::dvec4& light, const glm::dvec3& x, const glm::dvec3& y) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto p = homogeneous(point, tag);
        const Vector<Number> l = vector<Number>(glm::dvec3(light));
        const Vector<Number> axis = light.w == 0 ? l : p.w * l - p.xyz;
        return dot(axis, cross(p.w * vector<Number>(x) - p.xyz, p.w * vector<Number>(y) - p.xyz));
    });
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
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const Vector<Number> p = vector<Number>(glm::dvec3(point));
        return dot(normal<Number>(triangle), point.w == 0 ? p : p - vector<Number>(triangle[0]));
    });
}

ReceiverPoint::ReceiverPoint(const Ray& ray, const Triangle& triangle) : ray_(ray), triangle_(triangle) {
    const DepthBounds t = depthBounds(ray, triangle);
    const Interval::Protector rounding;
    const Interval depth(t.low, t.high);
    for (int axis = 0; axis < 3; ++axis) {
        const Interval x = Interval(ray.origin[axis]) + depth * Interval(ray.direction[axis]);
        low_[axis] = x.inf();
        high_[axis] = x.sup();
    }
}

ReceiverPoint::~ReceiverPoint() = default;

const ReceiverPoint::Exact& ReceiverPoint::exact() const {
    if (exact_) return *exact_;
    auto [numerator, denominator] = depthFraction<Ring>(ray_, triangle_);
    if (signOf(denominator) < 0) {
        numerator = -numerator;
        denominator = -denominator;
    }
    exact_ = std::make_unique<Exact>(
        Exact{denominator * vector<Ring>(ray_.origin) + numerator * vector<Ring>(ray_.direction), denominator});
    return *exact_;
}

int side(const Triangle& triangle, const ReceiverPoint& point) {
    return filteredSign([&](auto tag) {
        using Number = typename decltype(tag)::type;
        const auto p = homogeneous(point, tag);
        return dot(normal<Number>(triangle), p.xyz - p.w * vector<Number>(triangle[0]));
    });
}

Blocking blocking(const ReceiverPoint& point, const glm::dvec4& light, const Triangle& t) {
    const int s0 = turn(point, light, t[0], t[1]);
    const int s1 = turn(point, light, t[1], t[2]);
    if (s0 * s1 < 0) return Blocking::None;
    const int s2 = turn(point, light, t[2], t[0]);
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

} // namespace shadowbench::groundtruth
