// The oracles `polygon` and `rays` on the planar receivers of a snapshot.
#pragma once

#include "groundtruth/cgal/hard/exact.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace shadowbench::groundtruth::testing {

using namespace hard;

/// Pixels.
struct Comparison {
    std::size_t compared = 0, shadowed = 0;
    std::size_t differing = 0;       // one says lit, the other shadowed
    std::size_t onEdge = 0;          // both say: on an edge
    std::size_t onEdgeInOneOnly = 0; // one says: on an edge
};

/// Labels every planar receiver that at least `minimumPixels` see by both.
inline Comparison compareOracles(const Snapshot& snapshot, glm::ivec2 size, std::size_t minimumPixels = 1) {
    const ExactScene exact(snapshot);
    const PrimaryHits primary = exact.primaryHits(size);
    Reference rays;
    exact.labelByRays(size, primary, rays);
    Reference polygon = rays;
    constexpr float untouched = -1;
    std::ranges::fill(polygon.visibility, untouched);
    std::size_t members = 0;
    for (const PlanarReceiver& receiver : exact.planarReceivers(primary, minimumPixels)) {
        exact.labelByPolygon(size, primary, receiver, polygon);
        members += receiver.pixels;
    }

    Comparison result;
    for (std::size_t i = 0; i < rays.visibility.size(); ++i) {
        if (polygon.visibility[i] == untouched) continue;
        EXPECT_EQ(primary.surface[i], Surface::Receiver);
        ++result.compared;
        const bool raysOn = rays.surface[i] == Surface::OnEdge, polygonOn = polygon.surface[i] == Surface::OnEdge;
        result.onEdge += raysOn && polygonOn;
        result.onEdgeInOneOnly += raysOn != polygonOn;
        if (raysOn || polygonOn) continue;
        result.shadowed += rays.visibility[i] == 0;
        result.differing += rays.visibility[i] != polygon.visibility[i];
    }
    EXPECT_EQ(result.compared, members);
    return result;
}

inline void expectAgreement(const Comparison& c) {
    EXPECT_EQ(c.differing, 0U);
    EXPECT_EQ(c.onEdgeInOneOnly, 0U);
}

} // namespace shadowbench::groundtruth::testing
