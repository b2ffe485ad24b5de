// What the tests of visible fractions share.
#pragma once

#include "groundtruth/cgal/area/area.h"
#include "scene/meshes/primitives.h"
#include "tests/support/exact_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace shadowbench::groundtruth::testing {

using namespace area;
using namespace hard;

/// What the fast form may differ from the exact one: some hundred edges, each rounded to a few 1e-16, stay well below.
constexpr double fastError = 1e-12;

/// A rectangle of side 2 at height 4, or the disk or line that it holds; the axes are binary fractions so that degenerate
/// positions are exact.
inline Light lightAbove(LightKind kind = LightKind::Rectangle) {
    return {kind, {0, 4, 0}, {0, -1, 0}, {2, 0, 0}, kind == LightKind::Line ? glm::dvec3(0) : glm::dvec3(0, 0, 2)};
}

/// The snapshot seen by a single pixel whose ray falls straight down on (x, height, z), from so near that occluders are
/// behind it.
inline Snapshot looksDownOn(Snapshot snapshot, const glm::dvec3& point) {
    const double above = 0x1p-9;
    snapshot.camera = {point + glm::dvec3(0, above, 0), point, {0, 0, -1}, 45, 0x1p-12, 60};
    return snapshot;
}

/// The fraction at a point of an upward surface, after comparing the fast form with the exact one.
inline VisibleFraction fractionAt(const Snapshot& snapshot, const glm::dvec3& point) {
    const Snapshot seen = looksDownOn(snapshot, point);
    const glm::ivec2 size(1, 1);
    const PrimaryHits primary = primaryHits(seen, size);
    const AreaScene scene(seen);
    const VisibleFraction fast = scene.fraction({0, 0}, size, primary), exact = scene.exactFraction({0, 0}, size, primary);
    EXPECT_NEAR(fast.low, exact.low, fastError);
    EXPECT_NEAR(fast.high, exact.high, fastError);
    return fast;
}

/// The same for lights without a bracket.
inline double visibleAt(const Snapshot& snapshot, const glm::dvec3& point) {
    const VisibleFraction fraction = fractionAt(snapshot, point);
    EXPECT_EQ(fraction.low, fraction.high);
    return fraction.low;
}

/// A ground at y = 0 under the light; occluders are added to it.
inline SceneBuilder litGround(LightKind kind = LightKind::Rectangle) {
    SceneBuilder scene;
    scene.add(plane(8));
    scene.get().light = lightAbove(kind);
    return scene;
}

} // namespace shadowbench::groundtruth::testing
