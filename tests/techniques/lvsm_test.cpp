// Layered variance shadow maps without GL: which depths a layer distinguishes, and the leak that clamping removes.
#include "tests/support/models/lvsm.h"
#include "tests/support/models/vsm.h"

#include <gtest/gtest.h>

namespace shadowbench::models {
namespace {

TEST(DepthLayer, OneLayerIsTheWholeRange) {
    const DepthLayer layer = depthLayer(0, 1, 0.3);
    EXPECT_EQ(layer.low, 0);
    EXPECT_EQ(layer.high, 1);
    EXPECT_EQ(layerDepth(layer, 0.37), 0.37);
}

TEST(DepthLayer, LayersCoverTheRangeAndReachIntoTheirNeighbours) {
    constexpr int count = 5;
    for (int i = 0; i + 1 < count; ++i) {
        const DepthLayer a = depthLayer(i, count, 0.1), b = depthLayer(i + 1, count, 0.1);
        EXPECT_NEAR(a.high - b.low, 2 * 0.1 / count, 1e-12);
    }
    EXPECT_EQ(depthLayer(0, count, 0.1).low, 0);
    EXPECT_EQ(depthLayer(count - 1, count, 0.1).high, 1);
}

TEST(LayerOf, AReceiverHasRoomOnBothSidesInItsLayer) {
    constexpr int count = 4;
    for (double depth = 0; depth <= 1; depth += 0.01) {
        const int index = layerOf(depth, count);
        ASSERT_GE(index, 0);
        ASSERT_LT(index, count);
        const double stored = layerDepth(depthLayer(index, count, 0.1), depth);
        EXPECT_GT(stored, index > 0 ? 0.07 : -1); // 0.1 of 1.2 or 1.1 thicknesses, less rounding
        EXPECT_LT(stored, index + 1 < count ? 0.93 : 2);
    }
}

/// Moments of a kernel of which a share `p` is at depth b and the rest at a, as the receiver's layer stores them, and the
/// bound there.
double boundInLayer(double a, double b, double p, double receiver, int count) {
    const int index = layerOf(receiver, count);
    const DepthLayer layer = depthLayer(index, count, 0.1);
    const double da = layerDepth(layer, a), db = layerDepth(layer, b);
    return chebyshevBound({(1 - p) * da + p * db, (1 - p) * da * da + p * db * db}, layerDepth(layer, receiver));
}

TEST(LayeredMoments, OccludersOfNearerLayersDoNotLeak) {
    EXPECT_NEAR(boundInLayer(0.1, 0.6, 0.5, 0.9, 1), 0.0625 / (0.0625 + 0.55 * 0.55), 1e-12); // as plain moments
    EXPECT_EQ(boundInLayer(0.1, 0.6, 0.5, 0.9, 4), 0);
}

TEST(LayeredMoments, OccludersOfTheReceiversLayerStillDo) {
    const double whole = boundInLayer(0.1, 0.8, 0.5, 0.9, 1), layered = boundInLayer(0.1, 0.8, 0.5, 0.9, 4);
    EXPECT_GT(layered, 0.05);
    EXPECT_LT(layered, whole);
}

TEST(LayeredMoments, KeepThePenumbraOfOneOccluder) {
    for (const double lit : {0.2, 0.5, 0.8}) EXPECT_NEAR(boundInLayer(0.3, 0.9, lit, 0.9, 4), lit, 1e-12);
}

} // namespace
} // namespace shadowbench::models
