// Number types and vectors for exact decisions. For .cpp files of groundtruth/cgal only: no other header shows CGAL.
#pragma once

#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/vector.h"

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>

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
