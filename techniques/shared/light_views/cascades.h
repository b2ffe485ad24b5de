// Partition of a view frustum's depth range (Scherzer 2.2.2, z-partitioning; no GL).
#pragma once

#include "scene/snapshot.h"

#include <vector>

namespace shadowbench::techniques {

/// Eye depths at which `count` slices of [near, far] meet, ends included (count + 1 values): the mix of geometrical and even
/// steps of the practical split, λ near (far/near)^(i/count) + (1 − λ) (near + (far − near) i/count).
std::vector<double> practicalSplits(double near, double far, int count, double lambda);

/// Least and greatest eye depth of what the camera sees of `box`; its near and far plane where it sees nothing.
struct DepthRange {
    double near, far;
};
DepthRange visibleDepths(const Bounds& box, const Camera& camera, double aspect);

} // namespace shadowbench::techniques
