// Depths of a map as 0 at the view's near and 1 at its far distance: `linearisation` is that of unit depths.
#include "shared/maps/linearised_map.glsl"

/// Of a window depth; 1 where nothing is in the way.
float unitDepth(float window) {
    return clamp(linearised(window), 0.0, 1.0);
}
