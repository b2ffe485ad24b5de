// Percentage-closer soft shadows over a map of linear depth: blocker search, penumbra width, filter. Shared by the techniques that
// start from it.
#include "shared/filters/blocker_search.glsl"

uniform vec2 searchTaps[SEARCH_TAPS];  // in [−1, 1]²
uniform vec2 filterTaps[FILTER_TAPS];

/// Step 1: mean depth of the blockers in the search window; −1 if there is none.
float averageBlockerDepth(LightReceiver r) {
    vec2 window = searchWindow(r);
    float sum = 0.0;
    int found = 0;
    for (int i = 0; i < SEARCH_TAPS; ++i) {
        vec2 offset = searchTaps[i] * window;
        float depth = texture(linearDepth, r.at + offset).r;
        if (!blocks(depth, r, offset)) continue;
        sum += abs(depth);
        ++found;
    }
    return found > 0 ? sum / float(found) : -1.0;
}

/// Steps 2 and 3: percentage-closer filtering over the penumbra's width.
float filteredVisibility(LightReceiver r, float blockerDepth) {
    vec2 reach = halfPenumbra(r, blockerDepth);
    float passed = 0.0;
    for (int i = 0; i < FILTER_TAPS; ++i) {
        vec2 offset = filterTaps[i] * reach;
        if (!blocks(texture(linearDepth, r.at + offset).r, r, offset)) passed += 1.0;
    }
    return passed / float(FILTER_TAPS);
}

float pcssVisibility(LightReceiver r, float blockerDepth) {
    return blockerDepth < 0.0 ? 1.0 : filteredVisibility(r, blockerDepth);
}
