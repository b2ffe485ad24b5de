// What decides the views of cascaded shadow maps (techniques/shared/maps/cascade_fit.h).
#pragma once

namespace shadowbench::techniques {

struct CascadeRule {
    int slices = 4;
    double lambda = 1;   // of `practicalSplits`
    double blend = 0;    // share of a slice, at its end, that the next slice's map holds, too
    bool visible = true; // fitted to the points that the G-buffer shows; else to the frustum within the scene's box
    bool warped = false; // by `fitLispsm`
    bool stable = false; // of a directional light: as `fitStable` does. Neither visible nor warped
    bool soft =
        false; // of an area light, not of its centre: parts of the scene's map, with all that hides some of the light
    bool late = false; // visible: to the points that the frame before showed; the first frame to its frustum
};

} // namespace shadowbench::techniques
