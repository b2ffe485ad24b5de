// Percentage-closer soft shadows over a map of linear depth: blocker search, penumbra width, filter. Shared by the techniques that
// start from it.
#include "shared/filters/blocker_search.glsl"

uniform vec2 searchTaps[SEARCH_TAPS];  // in [−1, 1]²
uniform vec2 filterTaps[FILTER_TAPS];

// Indices are held in range by min() so that a compiler does not take an array's length for that of the loop: one that may be empty must
// not be unrolled.

/// Step 1: mean depth of the blockers that the first `taps` taps find in the search window; −1 if there is none.
float averageBlockerDepth(LightReceiver r, int taps) {
    vec2 window = searchWindow(r);
    float sum = 0.0;
    int found = 0;
    for (int i = 0; i < taps; ++i) {
        vec2 offset = searchTaps[min(i, SEARCH_TAPS - 1)] * window;
        float depth = linearDepthAt(r.at + offset);
        if (!blocks(depth, r, offset)) continue;
        sum += depth;
        ++found;
    }
    return found > 0 ? sum / float(found) : -1.0;
}

/// Steps 2 and 3: percentage-closer filtering with the first `taps` taps over the penumbra's width; 1 without blockers.
float pcssVisibility(LightReceiver r, float blockerDepth, int taps) {
    vec2 reach = halfPenumbra(r, blockerDepth);
    float passed = 0.0;
    for (int i = 0; i < taps; ++i) {
        vec2 offset = filterTaps[min(i, FILTER_TAPS - 1)] * reach;
        if (!blocks(linearDepthAt(r.at + offset), r, offset)) passed += 1.0;
    }
    return blockerDepth < 0.0 ? 1.0 : passed / float(taps);
}
