// The Fourier step without GL: what it converges to, how it rings, what damping does.
#include "techniques/filtered/csm-fourier/csm-fourier.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

/// How far the step exceeds 1 anywhere.
double overshoot(int terms, double damping) {
    double most = 0;
    for (double x = 0; x <= 0.5; x += 0.02 / terms) most = std::max(most, fourierStep(x, terms, damping) - 1);
    return most;
}

/// Root of the mean squared difference from the step over the whole wave.
double rmsError(int terms, double damping) {
    double squares = 0;
    int count = 0;
    for (double x = -1 + 5e-5; x < 1; x += 1e-4, ++count) {
        const double difference = fourierStep(x, terms, damping) - (x > 0 ? 1 : 0);
        squares += difference * difference;
    }
    return std::sqrt(squares / count);
}

TEST(FourierStep, IsOddAroundAHalf) {
    for (const double x : {0.01, 0.2, 0.7}) EXPECT_NEAR(fourierStep(x, 7, 0.4) + fourierStep(-x, 7, 0.4), 1, 1e-12);
    EXPECT_EQ(fourierStep(0, 7, 0), 0.5);
}

TEST(FourierStep, OneTermIsASine) { EXPECT_NEAR(fourierStep(0.5, 1, 0), 0.5 + 2 / glm::pi<double>(), 1e-12); }

TEST(FourierStep, ErrorFallsAsOneOverTheRootOfTheTerms) {
    // Parseval: what is left out is Σ 1/c_k² over the other terms, about 1 / (π² · 2 M) of the whole.
    for (const int terms : {4, 8, 16, 32})
        EXPECT_NEAR(rmsError(terms, 0), std::sqrt(1 / (glm::pi<double>() * glm::pi<double>() * 2 * terms)),
                    0.05 * rmsError(terms, 0));
}

TEST(FourierStep, OvershootsByGibbsConstantHoweverManyTerms) {
    constexpr double gibbs = 0.0894898722; // Si(π) / π − ½
    EXPECT_NEAR(overshoot(256, 0), gibbs, 1e-4);
    double before = 1;
    for (const int terms : {1, 2, 4, 8, 16, 32}) {
        const double now = overshoot(terms, 0);
        EXPECT_GT(now, gibbs);
        EXPECT_LT(now, before);
        before = now;
    }
}

TEST(FourierStep, TheFirstPeakIsHalfAShortestWaveFromTheStep) {
    for (const int terms : {4, 16}) {
        const double peak = fourierStep(0.5 / terms, terms, 0);
        EXPECT_NEAR(peak, 1 + overshoot(terms, 0), 1e-4);
    }
}

TEST(FourierStep, DampingTradesOvershootForWidth) {
    EXPECT_LT(overshoot(16, 1), 0.2 * overshoot(16, 0));
    EXPECT_LT(fourierStep(0.25 / 16, 16, 1), fourierStep(0.25 / 16, 16, 0)); // rises later
}

TEST(LitGain, LiftsASurfaceToOneAndLeavesAnUndampedSeriesAlone) {
    for (const int terms : {2, 4, 8, 16, 32})
        for (const double damping : {0.0, 1.0, 4.0})
            EXPECT_GE(litGain(terms, damping, 0.5 / terms) * fourierStep(0.5 / terms, terms, damping), 1.03 - 1e-12);
    EXPECT_EQ(litGain(16, 0, 0.5 / 16), 1);
}

// Sine and cosine are rounded to 8 bits as they are stored and twice as they are filtered, each time by half of 2/255 at
// most.
TEST(LitGain, HasRoomForAllRoundingAtTheDefaultOffsetAndNotMuchBelow) {
    constexpr int terms = 16;
    double rounding = 0;
    for (int k = 1; k <= terms; ++k)
        rounding += fourierDamping(k, terms, 1) * 2 / fourierFrequency(k) * std::sqrt(2.0) * 3 / 255;
    const auto darkest = [&](double offset) {
        const double x = 0.5 * offset / terms;
        return litGain(terms, 1, x) * (fourierStep(x, terms, 1) - rounding);
    };
    EXPECT_GE(darkest(0.5), 1);
    EXPECT_LT(darkest(0.4), 1);
}

TEST(LitGain, AnOccluderNearerThanTheStepIsLostAndHalvingTheOffsetHalvesTheStep) {
    const auto halfLit = [](double offset) { // in 1/(2M) of the depth range
        double gap = 0;
        const double x = 0.5 * offset / 16;
        while (litGain(16, 1, x) * fourierStep(x - 0.5 * gap / 16, 16, 1) > 0.5) gap += 0.001;
        return gap;
    };
    EXPECT_NEAR(halfLit(1), 1.02, 0.01);
    EXPECT_NEAR(halfLit(0.5), 0.64, 0.01);
    EXPECT_NEAR(halfLit(0.25), 0.49, 0.01);
}

TEST(UsedDepth, KeepsTheWholeRangeOffTheWavesNextStep) {
    for (const int terms : {4, 8, 16, 32})
        for (const double side : {-1.0, 1.0}) { // the offset included
            const double x = side * usedDepth(terms) + 0.5 / terms;
            EXPECT_NEAR(fourierStep(x, terms, 0), side > 0 ? 1 : 0, 0.11) << terms;
        }
}

} // namespace
} // namespace shadowbench::techniques
