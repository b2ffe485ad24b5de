// Partition of a view frustum's depth range (Scherzer 2.2.2, z-partitioning; no GL).
#pragma once

#include "scene/snapshot.h"
#include "techniques/shared/light_views/light_view.h"

#include <cstddef>
#include <vector>

namespace shadowbench::techniques {

/// Eye depths at which `count` slices of [near, far] meet, ends included (count + 1 values): the mix of geometrical and even
/// steps of the practical split, λ near (far/near)^(i/count) + (1 − λ) (near + (far − near) i/count).
std::vector<double> practicalSplits(double near, double far, int count, double lambda);

/// The slice of `splits` (two depths or more) that holds an eye depth; the first and the last also hold what lies beyond
/// them. The same as sliceOf() of shared/maps/slice.glsl (compared in tests/techniques/gl/map_point_test.cpp).
std::size_t sliceOf(const std::vector<double>& splits, double depth);

/// Least and greatest eye depth.
struct DepthRange {
    double near, far;
};

/// The depths that the map of each slice of `splits` has to hold: the slice's own, and the last `blend` of the slice before
/// it (a share of that one's length), where its map takes over.
std::vector<DepthRange> sliceRanges(const std::vector<double>& splits, double blend);

/// Depths of what the camera sees of `box`; its near and far plane where it sees nothing.
DepthRange visibleDepths(const Bounds& box, const Camera& camera, double aspect);

/// A ball in world space.
struct Sphere {
    glm::dvec3 centre;
    double radius;
};

/// The smallest ball around the frustum between the camera's near and far plane. Its radius is that of every camera with the
/// same planes and angle of view, to the bit.
Sphere frustumSphere(const Camera& camera, double aspect);

/// A directional light's map of the frustum between `slice`'s planes whose texels stay where they are in the world while the
/// camera moves and turns (Valient, "Stable rendering of cascaded shadow maps", ShaderX6): it is as large as the frustum's
/// ball, and moves by whole texels. `texels` per side. Depths are those of `fitToScene`.
LightView fitStable(const Light& light, const Snapshot& snapshot, const Camera& slice, double aspect, int texels);

} // namespace shadowbench::techniques
