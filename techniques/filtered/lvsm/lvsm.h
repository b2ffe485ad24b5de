// The layers of layered variance shadow maps, as filtered/lvsm/layers.glsl computes them.
#pragma once

namespace shadowbench::techniques {

/// The part of the depth range [0, 1] that a layer tells apart.
struct DepthLayer {
    double low, high;
};

/// Layer `index` of `count` of equal thickness, each reaching `overlap` of a thickness into its neighbours.
DepthLayer depthLayer(int index, int count, double overlap);

/// Depth as the layer stores it: 0 up to its low and 1 from its high end on.
double layerDepth(const DepthLayer& layer, double depth);

/// The layer that a receiver at `depth` is tested in.
int layerOf(double depth, int count);

} // namespace shadowbench::techniques
