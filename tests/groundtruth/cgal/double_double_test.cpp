// Double-double numbers against rational ones: the bound of the error holds, and is small.
#include "groundtruth/cgal/area/area_double_double.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <random>

namespace shadowbench::groundtruth::area {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exact(const DoubleDouble& value) { return Rational(value.high) + Rational(value.low); }

class DoubleDoubles : public testing::Test {
protected:
    /// Of any size from 2⁻²⁰ to 2²⁰ and both signs, with an error of its own or none.
    DoubleDouble draw() {
        std::uniform_real_distribution<double> mantissa(-1, 1);
        std::uniform_int_distribution<int> exponent(-20, 20);
        const DoubleDouble first(std::ldexp(mantissa(random_), exponent(random_)));
        const DoubleDouble value = first + DoubleDouble(first.high * 0x1p-54 * mantissa(random_));
        return {value.high, value.low, exponent(random_) > 0 ? std::abs(value.high) * 0x1p-90 : 0};
    }

    /// `truth` is the result for the operands' own high + low, which are within their errors.
    static void expectBounded(const DoubleDouble& result, const Rational& truth, double carried) {
        EXPECT_LE(abs(exact(result) - truth), Rational(result.error));
        EXPECT_LE(result.error, 1.01 * carried + 0x1p-96 * std::abs(result.high) + 0x1p-900);
        EXPECT_LE(std::abs(result.low), 0x1p-53 * std::abs(result.high));
    }

    std::mt19937 random_{7};
};

TEST_F(DoubleDoubles, SumsProductsAndQuotientsLieWithinTheirBounds) {
    for (int i = 0; i < 2000; ++i) {
        const DoubleDouble a = draw(), b = draw();
        expectBounded(a + b, exact(a) + exact(b), a.error + b.error);
        expectBounded(a - b, exact(a) - exact(b), a.error + b.error);
        const double ofProduct = std::abs(a.high) * b.error + std::abs(b.high) * a.error;
        expectBounded(a * b, exact(a) * exact(b), ofProduct);
        const double quotient = std::abs(a.high / b.high);
        expectBounded(a / b, exact(a) / exact(b), (a.error + quotient * b.error) / std::abs(b.high));
    }
}

TEST_F(DoubleDoubles, AnErrorOfAnOperandMovesTheResultByNoMoreThanItsBound) {
    for (int i = 0; i < 2000; ++i) {
        const DoubleDouble a = draw(), b = draw();
        const Rational moved = exact(a) + Rational(a.error), other = exact(b) - Rational(b.error);
        const auto expect = [](const DoubleDouble& result, const Rational& truth) {
            EXPECT_LE(abs(exact(result) - truth), Rational(result.error));
        };
        expect(a + b, moved + other);
        expect(a - b, moved - other);
        expect(a * b, moved * other);
        expect(a / b, moved / other);
    }
}

TEST_F(DoubleDoubles, CancellationLeavesTheBoundOfTheOperands) {
    const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
    const DoubleDouble nothing = third * DoubleDouble(3) - DoubleDouble(1);
    EXPECT_LE(abs(exact(nothing)), Rational(nothing.error));
    EXPECT_LT(nothing.error, 0x1p-94);
    const DoubleDouble zero = DoubleDouble(5) - DoubleDouble(5);
    EXPECT_EQ(zero.high, 0);
    EXPECT_EQ(zero.error, 0);
}

TEST_F(DoubleDoubles, AQuotientByWhatMayBeNothingHasNoBound) {
    EXPECT_TRUE(std::isinf((DoubleDouble(1) / DoubleDouble(1e-30, 0, 1e-29)).error));
    EXPECT_TRUE(std::isinf((DoubleDouble(1) / DoubleDouble(0)).error));
}

} // namespace
} // namespace shadowbench::groundtruth::area
