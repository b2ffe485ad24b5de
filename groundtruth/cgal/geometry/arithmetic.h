// Number types and vectors for exact decisions. For .cpp files of groundtruth/cgal only: no other header shows CGAL.
#pragma once

#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/vector.h"

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>

#include <cmath>
#include <type_traits>

namespace shadowbench::groundtruth::geometry {

using Interval = CGAL::Interval_nt<false>;                      // rounding set by Interval::Protector
using Ring = CGAL::internal::Exact_ring_selector<double>::Type; // no division is needed anywhere

/// −1, 0 or 1. Throws CGAL::Uncertain_conversion_exception where `value` is an interval that leaves the sign open.
template <typename Number>
int signOf(const Number& value) {
    return static_cast<int>(CGAL::make_certain(CGAL_NTS sign(value)));
}

/// The sign of `polynomial`, a function of the number type (as std::type_identity) to compute in.
template <typename Polynomial>
int filteredSign(const Polynomial& polynomial) {
    {
        const Interval::Protector rounding;
        const CGAL::Uncertain<CGAL::Sign> sign = CGAL_NTS sign(polynomial(std::type_identity<Interval>()));
        if (CGAL::is_certain(sign)) return static_cast<int>(CGAL::get_certain(sign));
    }
    return signOf<Ring>(polynomial(std::type_identity<Ring>()));
}

/// Of a determinant of three vectors, as a share of the same with every term positive. Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates" (1997), orient3d, stage A: (7 + 56 ε) ε, rounded up, and
/// twice that, for whoever asks may have rounding directed.
constexpr double determinantError = 16 * 0x1p-53;
constexpr double sumsRoundedUp = 1 + 0x1p-20;

/// Sign of a determinant of three vectors, each given or a rounded difference of two points; 0 where rounding could have
/// changed it. `magnitude`: with every term positive; `more`: what else the value can be wrong by.
inline int certainSign(double determinant, double magnitude, double more = 0) {
    const double bound = determinantError * magnitude + sumsRoundedUp * more;
    constexpr double underflow = 1e-200; // far above what lost subnormal products can add up to
    if (!(bound > underflow && std::abs(determinant) > bound)) return 0;
    return determinant > 0 ? 1 : -1;
}

/// The point xyz / w, w > 0.
template <typename Number>
struct Homogeneous {
    Vector<Number> xyz;
    Number w;
};

struct ReceiverPoint::Exact {
    Homogeneous<Ring> point;
};

inline Homogeneous<Interval> homogeneous(const ReceiverPoint& p, std::type_identity<Interval>) {
    return {{Interval(p.low().x, p.high().x), Interval(p.low().y, p.high().y), Interval(p.low().z, p.high().z)},
            Interval(1)};
}

inline const Homogeneous<Ring>& homogeneous(const ReceiverPoint& p, std::type_identity<Ring>) { return p.exact().point; }

} // namespace shadowbench::groundtruth::geometry
