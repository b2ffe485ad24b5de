// Partition of a view frustum's depth range (Scherzer 2.2.2, z-partitioning; no GL).
#pragma once

#include "scene/snapshot.h"

#include <cstddef>
#include <vector>

namespace shadowbench::techniques {

/// Eye depths at which `count` slices of [near, far] meet, ends included (count + 1 values): the mix of geometrical and even
/// steps of the practical split, λ near (far/near)^(i/count) + (1 − λ) (near + (far − near) i/count).
std::vector<double> practicalSplits(double near, double far, int count, double lambda);

/// The slice of `splits` (two depths or more) that holds an eye depth; the first and the last also hold what lies beyond
/// them. The same as sliceOf() of maps/sm-cascaded/slice.glsl (compared in tests/techniques/gl/map_point_test.cpp).
std::size_t sliceOf(const std::vector<double>& splits, double depth);

/// Least and greatest eye depth of what the camera sees of `box`; its near and far plane where it sees nothing.
struct DepthRange {
    double near, far;
};
DepthRange visibleDepths(const Bounds& box, const Camera& camera, double aspect);

} // namespace shadowbench::techniques
