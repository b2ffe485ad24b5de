// Depth as layer `index` of LAYERS stores it (Lauritzen and McCool 2008): 0 up to its low and 1 from its high end on.
uniform float overlap;  // of a layer's thickness, into each neighbour

float layerDepth(float depth, int index) {
    float low = (float(index) - (index > 0 ? overlap : 0.0)) / float(LAYERS);
    float high = (float(index + 1) + (index + 1 < LAYERS ? overlap : 0.0)) / float(LAYERS);
    return clamp((depth - low) * (1.0 / (high - low)), 0.0, 1.0);
}

/// The layer that a receiver at `depth` is tested in.
int layerOf(float depth) {
    return min(int(depth * float(LAYERS)), LAYERS - 1);
}
