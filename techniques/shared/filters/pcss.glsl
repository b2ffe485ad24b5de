// Percentage-closer soft shadows over a map of linear depth: blocker search, penumbra width, filter. Shared by the techniques that
// start from it.
#include "shared/maps/light_receiver.glsl"

uniform sampler2D linearDepth;   // negative: moving caster
uniform vec2 lightHalfSize;      // half the light's sides along map x and y, metres
uniform vec2 mapSpan;            // width and height of the map at unit depth
uniform float nearDepth;         // no caster is nearer to the light
uniform vec2 searchTaps[SEARCH_TAPS];  // in [−1, 1]²
uniform vec2 filterTaps[FILTER_TAPS];

bool blocks(float mapDepth, LightReceiver r, vec2 offset) {
    return abs(mapDepth) < planeDepth(r, offset);
}

/// Step 1: mean depth of the blockers in the light's projection from the receiver onto the near plane of the map; −1 if there is none.
float averageBlockerDepth(LightReceiver r) {
    vec2 window = lightHalfSize * max(r.depth - nearDepth, 0.0) / (r.depth * nearDepth) / mapSpan;
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

/// Steps 2 and 3: penumbra width by similar triangles (Zápotocký eq. 3.3), then percentage-closer filtering over it.
float filteredVisibility(LightReceiver r, float blockerDepth) {
    vec2 halfPenumbra = lightHalfSize * max(r.depth - blockerDepth, 0.0) / blockerDepth / (r.depth * mapSpan);
    float passed = 0.0;
    for (int i = 0; i < FILTER_TAPS; ++i) {
        vec2 offset = filterTaps[i] * halfPenumbra;
        if (!blocks(texture(linearDepth, r.at + offset).r, r, offset)) passed += 1.0;
    }
    return passed / float(FILTER_TAPS);
}

float pcssVisibility(LightReceiver r, float blockerDepth) {
    return blockerDepth < 0.0 ? 1.0 : filteredVisibility(r, blockerDepth);
}
