// Numbers of twice the precision of a double, each with a certain bound of its error: between intervals of doubles, which
// are too wide where a triangle comes close to the surface point, and rational numbers, which cost ten times as much.
// Joldes, Muller and Popescu, Tight and rigorous error bounds for basic building blocks of double-word arithmetic, 2017.
#pragma once

#include <cmath>

namespace shadowbench::groundtruth::area {

/// The true value lies within `error` of high + low, |low| ≤ ulp(high)/2. Rounding must be to nearest.
struct DoubleDouble {
    double high = 0, low = 0, error = 0;

    DoubleDouble() = default;
    explicit DoubleDouble(double value) : high(value) {}
    DoubleDouble(double first, double second, double bound) : high(first), low(second), error(bound) {}
};

namespace double_double {

constexpr double relative = 0x1p-98;    // above the relative error of every operation here, 2⁻¹⁰⁴ to 2⁻¹⁰⁰
constexpr double rounded = 1 + 0x1p-40; // the roundings of a bound itself
constexpr double underflow = 0x1p-960;  // what a product may lose below the least normal number, and much more

struct Pair {
    double high, low;
};

/// a + b exactly (Knuth); `ordered`: |a| ≥ |b| (Dekker).
inline Pair sum(double a, double b) {
    const double s = a + b, t = s - a;
    return {s, (a - (s - t)) + (b - t)};
}
inline Pair ordered(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
}

/// a · b exactly (Veltkamp and Dekker).
inline Pair product(double a, double b) {
    constexpr double splitter = 0x1p27 + 1;
    const auto split = [](double x) {
        const double c = splitter * x, high = c - (c - x);
        return Pair{high, x - high};
    };
    const Pair x = split(a), y = split(b);
    const double p = a * b;
    return {p, ((x.high * y.high - p) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

/// `carried`: what the errors of the operands make of it.
inline DoubleDouble bounded(const Pair& value, double carried) {
    return {value.high, value.low, rounded * (carried + relative * std::abs(value.high))};
}

} // namespace double_double

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.high, -a.low, a.error}; }

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    const Pair s = sum(a.high, b.high), t = sum(a.low, b.low);
    const Pair v = ordered(s.high, s.low + t.high);
    return bounded(ordered(v.high, t.low + v.low), a.error + b.error);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    const Pair p = product(a.high, b.high);
    const double carried = std::abs(a.high) * b.error + std::abs(b.high) * a.error + a.error * b.error;
    const bool exactZero = a.high == 0 || b.high == 0;
    return bounded(ordered(p.high, p.low + (a.high * b.low + a.low * b.high)), exactZero ? carried : carried + underflow);
}

/// Not a number, with an infinite bound, if b may be 0.
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    using namespace double_double;
    const double least = std::abs(b.high) * (1 - 0x1p-40) - b.error;
    if (!(least > 0)) return {NAN, NAN, INFINITY};
    const DoubleDouble exactA(a.high, a.low, 0), exactB(b.high, b.low, 0);
    const double first = a.high / b.high;
    const DoubleDouble rest = exactA - exactB * DoubleDouble(first);
    const double second = rest.high / b.high;
    const DoubleDouble left = rest - exactB * DoubleDouble(second);
    const Pair quotient = ordered(first, second);
    const DoubleDouble q = DoubleDouble(quotient.high, quotient.low, 0) + DoubleDouble(left.high / b.high);
    const double carried = (a.error + std::abs(q.high) * b.error) / least;
    // What the remainders are off by, and their last one, of which a third quotient holds 53 bits.
    const double rounding = (left.error + rest.error + 0x1p-50 * std::abs(left.high)) / least;
    return bounded({q.high, q.low}, a.high == 0 ? carried : carried + rounding + underflow);
}

} // namespace shadowbench::groundtruth::area
