// Number types and vectors for exact decisions. For the .cpp files of this folder only: nothing else sees CGAL.
#pragma once

#include "groundtruth/cgal/geometry/predicates.h"
#include "groundtruth/cgal/geometry/vector.h"

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>

#include <type_traits>

namespace shadowbench::groundtruth {

using Interval = CGAL::Interval_nt<false>;                      // rounding set by Interval::Protector
using Ring = CGAL::internal::Exact_ring_selector<double>::Type; // no division is needed anywhere

inline CGAL::Uncertain<CGAL::Sign> signOf(const Interval& value) { return CGAL_NTS sign(value); }

inline int signOf(const Ring& value) { return static_cast<int>(CGAL_NTS sign(value)); }

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

} // namespace shadowbench::groundtruth
