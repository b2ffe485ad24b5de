// The seeds' own numbers: confidence, exponential smoothing, Table 4.1, Halton points, P_inf.
#include "techniques/maps/sm-history/sm-history.h"
#include "techniques/shared/casters/shadow_volume.h"
#include "techniques/shared/sampling/sampling.h"
#include "tests/support/models/sm_history.h"
#include "tests/support/models/temporal_soft.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace shadowbench::techniques {
namespace {

using namespace models;

TEST(Confidence, IsOneAtATexelCentreAndZeroAtItsBorder) {
    EXPECT_DOUBLE_EQ(confidence({7.5, 3.5}), 1);
    EXPECT_DOUBLE_EQ(confidence({7.0, 3.5}), 0);
    EXPECT_DOUBLE_EQ(confidence({7.5, 3.75}), 0.5);
    EXPECT_DOUBLE_EQ(confidence({7.4, 3.75}), 0.5); // the larger distance counts (max norm)
}

TEST(History, ASampleAtATexelCentreReplacesTheHistory) { EXPECT_DOUBLE_EQ(smoothed(0.3, 1, 1, 15), 1); }

TEST(History, ASampleAtATexelBorderChangesNothing) { EXPECT_DOUBLE_EQ(smoothed(0.3, 1, 0, 3), 0.3); }

TEST(History, LargerMTakesLessOfAnUnsureSample) {
    EXPECT_DOUBLE_EQ(smoothed(0, 1, 0.5, 3), 0.125);
    EXPECT_LT(smoothed(0, 1, 0.5, 15), 1e-4);
}

TEST(History, MGrowsByAStepWhileTheCameraStandsStill) {
    MSchedule schedule(3, 0.1);
    EXPECT_DOUBLE_EQ(schedule.next(false), 3);
    EXPECT_DOUBLE_EQ(schedule.next(false), 3.1);
    EXPECT_NEAR(schedule.next(false), 3.2, 1e-12);
    EXPECT_DOUBLE_EQ(schedule.next(true), 3);
    schedule.next(false);
    schedule.reset();
    EXPECT_DOUBLE_EQ(schedule.next(false), 3);
}

// Dissertation, Table 4.1, printed to two decimals.
TEST(TemporalSoft, EstimatesMatchTable41) {
    constexpr std::array<double, 7> tau{1, 0, 1, 1, 1, 0, 1};
    constexpr std::array<double, 7> estimate{1.00, 0.50, 0.67, 0.75, 0.80, 0.67, 0.71};
    constexpr std::array<double, 7> variance{0, 0.25, 0.11, 0.06, 0.04, 0.04, 0.03};
    constexpr std::array<double, 7> standardError{0, 0.50, 0.33, 0.25, 0.20, 0.21, 0.18};
    double shadowed = 0;
    for (std::size_t i = 0; i < tau.size(); ++i) {
        const auto n = static_cast<double>(i + 1);
        EXPECT_DOUBLE_EQ(occlusionUpdate(shadowed, n - 1, tau[i]), occlusionEstimate(shadowed + tau[i], n));
        shadowed += tau[i];
        const double psi = occlusionEstimate(shadowed, n);
        EXPECT_NEAR(psi, estimate[i], 0.005);
        EXPECT_NEAR(occlusionVariance(psi, n), variance[i], 0.005);
        EXPECT_NEAR(std::sqrt(occlusionVariance(psi, n)), standardError[i], 0.005);
    }
}

TEST(TemporalSoft, MeanBlockerDepthIsThePlainMeanOfAllDepths) {
    const double k = 16, start = 4; // sixteen search depths of mean 4
    const double mean = blockerUpdate(blockerUpdate(start, 6, 1, k), 8, 2, k);
    EXPECT_NEAR(mean, (16 * 4.0 + 6 + 8) / 18, 1e-12);
}

TEST(Halton, FirstElementsAreTheVanDerCorputSequence) {
    constexpr std::array<double, 5> base2{0, 0.5, 0.25, 0.75, 0.125};
    for (std::uint32_t i = 0; i < base2.size(); ++i) EXPECT_DOUBLE_EQ(halton(i, 2), base2[i]);
    EXPECT_NEAR(halton(1, 3), 1.0 / 3, 1e-15);
    EXPECT_NEAR(halton(2, 3), 2.0 / 3, 1e-15);
    EXPECT_NEAR(halton(3, 3), 1.0 / 9, 1e-15);
}

TEST(Halton, NoSeedHasThePointsOfAnotherSomeFramesLater) {
    const auto point = [](int frame, std::uint32_t seed) {
        return glm::dvec2(haltonOf(frame, seed, 2), haltonOf(frame, seed, 3));
    };
    EXPECT_EQ(point(0, 1), glm::dvec2(0.5, 1.0 / 3));
    constexpr int frames = 64;
    for (std::uint32_t a = 1; a <= 16; ++a)
        for (std::uint32_t b = a + 1; b <= 16; ++b)
            for (int shift = -8; shift <= 8; ++shift) {
                double distance = 0;
                for (int frame = 8; frame < 8 + frames; ++frame)
                    distance += glm::distance(point(frame, a), point(frame + shift, b)) / frames;
                // Independent points of the unit square lie half a side apart. Two seeds that turn by nearly the same
                // angles come nearer; starts in one sequence came within a fiftieth.
                EXPECT_GT(distance, 0.1) << a << " " << b << " " << shift;
            }
}

TEST(Halton, AnyRunOfAPowerOfTheBaseFillsEveryCellOnce) {
    std::array<int, 16> hits{};
    for (std::uint32_t i = 100; i < 116; ++i) ++hits[static_cast<std::size_t>(16 * halton(i, 2))];
    for (const int count : hits) EXPECT_EQ(count, 1);
}

TEST(PoissonTaps, StayInTheirRegionAndApart) {
    for (const Region region : {Region::Disk, Region::Square}) {
        const auto taps = poissonTaps(32, region);
        ASSERT_EQ(taps.size(), 32U);
        for (std::size_t i = 0; i < taps.size(); ++i) {
            EXPECT_LE(region == Region::Disk ? glm::length(taps[i]) : std::max(std::abs(taps[i].x), std::abs(taps[i].y)),
                      1.0F);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GT(glm::distance(taps[i], taps[j]), 0.15F); // 32 disks of 0.17 fit with room
        }
    }
}

TEST(PoissonTaps, AreTheSameEveryTime) { EXPECT_EQ(poissonTaps(16, Region::Disk), poissonTaps(16, Region::Disk)); }

TEST(GridTaps, AreCellCentres) {
    const auto taps = gridTaps(5);
    ASSERT_EQ(taps.size(), 25U);
    EXPECT_FLOAT_EQ(taps.front().x, -0.8F);
    EXPECT_FLOAT_EQ(taps.back().y, 0.8F);
}

// Everitt–Kilgard 3.2.1.
TEST(InfiniteProjection, AVertexAtInfinityLandsAtDepthOne) {
    const glm::dmat4 p = infiniteProjection(glm::perspective(1.0, 1.5, 1.0, 100.0), 1.0);
    const glm::dvec4 infinite = p * glm::dvec4(0.3, -0.2, -1, 0);
    EXPECT_DOUBLE_EQ(infinite.z, infinite.w);
    const glm::dvec4 near = p * glm::dvec4(0, 0, -1, 1);
    EXPECT_DOUBLE_EQ(near.z, -near.w);
}

TEST(InfiniteProjection, SqueezesDepthByOnePercentAtNearOneFarAHundred) {
    const glm::dmat4 finite = glm::perspective(1.0, 1.0, 1.0, 100.0);
    const glm::dmat4 infinite = infiniteProjection(finite, 1.0);
    const auto window = [](const glm::dmat4& p, double z) {
        const glm::dvec4 h = p * glm::dvec4(0, 0, -z, 1);
        return 0.5 * h.z / h.w + 0.5;
    };
    EXPECT_NEAR(window(infinite, 50) / window(finite, 50), 0.99, 1e-12); // (Far − Near) / Far
}

} // namespace
} // namespace shadowbench::techniques
