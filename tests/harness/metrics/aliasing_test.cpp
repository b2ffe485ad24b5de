// The projected-texel-to-pixel ratio of maps that look at a plane in a known way.
#include "harness/metrics/frames.h"
#include "harness/metrics/table.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace shadowbench::metrics {
namespace {

constexpr int side = 9; // odd: the middle pixel's centre is on the view axis
constexpr double distance = 4, texelsPerMetre = 100;

/// Looks along −z at the point (0, 0, −distance).
Camera camera() { return {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 30, 0.1, 100}; }

/// Metres between neighbouring pixels at right angles to the view axis, `distance` in front of the eye.
double pixelSize() { return 2 * distance * std::tan(glm::radians(15.0)) / side; }

/// The plane through (0, 0, −distance) that is turned about x by `tilt` (radians) from facing the camera, at every pixel.
struct View {
    Image<glm::vec3> positions{side, side}, normals{side, side};
    Mask mask{Image<std::uint8_t>(side, side, 1), 0, side* side};

    explicit View(double tilt = 0) {
        const glm::dvec3 normal(0, std::sin(tilt), std::cos(tilt));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const glm::dvec3 ray = camera().ray({x + 0.5, y + 0.5}, {side, side});
                positions(x, y) = glm::vec3(-distance * normal.z / glm::dot(normal, ray) * ray);
                normals(x, y) = glm::vec3(normal);
            }
    }

    /// Only the middle pixel is a receiver.
    View& middleOnly() {
        mask.scored = Image<std::uint8_t>(side, side, 0);
        mask.scored(side / 2, side / 2) = 1;
        mask.count = 1;
        return *this;
    }

    [[nodiscard]] std::optional<Aliasing> seenBy(const MapPoint& mapPoint) const {
        return aliasing({camera(), positions, normals, mask, mapPoint});
    }
};

/// Along z, its axes turned by `turn`; `squeeze` times as many texels along the turned y.
MapPoint alongZ(double turn = 0, double squeeze = 1) {
    return [=](const glm::dvec3& p) {
        const double c = std::cos(turn), s = std::sin(turn);
        return std::optional(texelsPerMetre * glm::dvec2(c * p.x + s * p.y, squeeze * (c * p.y - s * p.x)));
    };
}

// Positions are 32-bit floats (relative 1e-7) and differences are taken over a 1024th of a pixel, forward: the perspective's
// curvature adds a millionth.
constexpr double rounding = 1e-4;

TEST(AliasingOf, AMapSeenHeadOnIsItsTexelSizeInPixelsEverywhere) {
    const double expected = 1 / (texelsPerMetre * pixelSize());
    const std::optional<Aliasing> found = View().seenBy(alongZ());
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->median, expected, rounding * expected);
    EXPECT_NEAR(found->p95, expected, rounding * expected);
    EXPECT_EQ(found->mapped, 1);
}

TEST(AliasingOf, TheWorstDirectionCountsWhicheverWayTheMapIsTurned) {
    const double expected = 1 / (0.2 * texelsPerMetre * pixelSize()); // the turned y has a fifth of the texels
    for (const double turn : {0.0, 0.4, 1.1}) {
        const std::optional<Aliasing> found = View().seenBy(alongZ(turn, 0.2));
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->median, expected, rounding * expected) << turn;
    }
}

TEST(AliasingOf, APlaneTiltedFromTheMapIsProjectionAliasing) {
    // The plane faces the camera; the map looks along a direction that is `tilt` off its normal: 1 / cos tilt of a texel.
    for (const double tilt : {0.5, 1.2, 1.5}) {
        const MapPoint tilted = [=](const glm::dvec3& p) {
            return std::optional(texelsPerMetre * glm::dvec2(p.x, p.y * std::cos(tilt) + (p.z + distance) * std::sin(tilt)));
        };
        const double expected = 1 / (texelsPerMetre * pixelSize() * std::cos(tilt));
        const std::optional<Aliasing> found = View().seenBy(tilted);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->median, expected, 1e-3 * expected) << tilt; // at 86° the tilt multiplies rounding by 14
    }
}

TEST(AliasingOf, APlaneTiltedFromTheCameraHasMoreTexelsAPixel) {
    // The map sees the plane head-on; a pixel spans 1 / cos tilt of it along y, and as much as ever along x.
    const double tilt = 1.2;
    const MapPoint headOn = [=](const glm::dvec3& p) {
        return std::optional(texelsPerMetre * glm::dvec2(p.x, p.y * std::cos(tilt) - (p.z + distance) * std::sin(tilt)));
    };
    const MapPoint fewerAlongY = [=](const glm::dvec3& p) {
        const glm::dvec2 texel = *headOn(p);
        return std::optional(glm::dvec2(texel.x, 0.1 * texel.y));
    };
    const double pixel = texelsPerMetre * pixelSize();
    View view(tilt);
    view.middleOnly();
    EXPECT_NEAR(view.seenBy(headOn)->median, 1 / pixel, rounding / pixel);
    EXPECT_NEAR(view.seenBy(fewerAlongY)->median, 10 * std::cos(tilt) / pixel, 1e-3 / pixel);
}

TEST(AliasingOf, ABorderBetweenTwoMapsDoesNotCount) {
    const MapPoint two = [](const glm::dvec3& p) {
        const glm::dvec2 texel = texelsPerMetre * glm::dvec2(p);
        return std::optional(texel + (p.x > 0 ? glm::dvec2(500, 0) : glm::dvec2(0))); // x = 0 lies on the middle pixels
    };
    const double expected = 1 / (texelsPerMetre * pixelSize());
    EXPECT_NEAR(View().middleOnly().seenBy(two)->median, expected, rounding * expected);
}

TEST(AliasingOf, WhatLiesInNoMapIsCounted) {
    const MapPoint left = [](const glm::dvec3& p) {
        return p.x > -1e-9 ? std::nullopt : std::optional(texelsPerMetre * glm::dvec2(p));
    };
    const std::optional<Aliasing> found = View().seenBy(left);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->mapped, 4.0 / 9); // four of the nine columns
    EXPECT_FALSE(View().seenBy([](const glm::dvec3&) { return std::nullopt; }));
    EXPECT_FALSE(View().seenBy([](const glm::dvec3&) { return std::optional(glm::dvec2(3)); })); // seen edge-on
}

} // namespace
} // namespace shadowbench::metrics
