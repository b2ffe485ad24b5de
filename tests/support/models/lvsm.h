// What filtered/lvsm/layers.glsl computes (Lauritzen and McCool 2008).
#pragma once

#include <algorithm>

namespace shadowbench::models {

/// The part of the depth range [0, 1] in which a layer distinguishes depths.
struct DepthLayer {
    double low, high;
};

/// Layer `index` of `count` of equal thickness, each reaching `overlap` of a thickness into its neighbours.
inline DepthLayer depthLayer(int index, int count, double overlap) {
    const double below = index > 0 ? overlap : 0, above = index + 1 < count ? overlap : 0;
    return {(index - below) / count, (index + 1 + above) / count};
}

/// Depth as the layer stores it: 0 up to its low and 1 from its high end on.
inline double layerDepth(const DepthLayer& layer, double depth) {
    return std::clamp((depth - layer.low) / (layer.high - layer.low), 0.0, 1.0);
}

/// The layer that a receiver at `depth` is tested in.
inline int layerOf(double depth, int count) { return std::min(static_cast<int>(depth * count), count - 1); }

} // namespace shadowbench::models
