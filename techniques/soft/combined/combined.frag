#define linearisation metreLinearisation
#include "gl/receiver.glsl"
#include "shared/filters/jitter_table.glsl"
#include "shared/filters/blocker_search.glsl"

uniform sampler2D normals;
uniform sampler2D searchJitter;
uniform sampler2D filterJitter;

const int searchTaps = 16, filterTaps = 32;
const int firstTaps = 8;  // of the filter's outermost ring

out float visibility;

/// Depth and 1 of the blocker at `offset` from the receiver; zero where there is none.
vec2 blockerAt(LightReceiver r, vec2 offset) {
    float depth = linearDepthAt(r.at + offset);
    return blocks(depth, r, offset) ? vec2(depth, 1.0) : vec2(0.0);
}

/// Step 1: mean depth of the blockers in the search window; −1 if there is none.
float meanBlockerDepth(LightReceiver r) {
    vec2 window = searchWindow(r);
    vec2 sum = vec2(0.0);
    for (int pair = 0; pair < searchTaps / 2; ++pair) {
        vec4 offsets = jitteredPair(searchJitter, pair) * window.xyxy;
        sum += blockerAt(r, offsets.xy) + blockerAt(r, offsets.zw);
    }
    return sum.y > 0.0 ? sum.x / sum.y : -1.0;
}

float testAt(LightReceiver r, vec2 offset) {
    return blocks(linearDepthAt(r.at + offset), r, offset) ? 0.0 : 1.0;
}

/// Steps 2 and 3. Without blockers no tap is taken.
float jitteredVisibility(LightReceiver r, float blockerDepth) {
    vec2 reach = halfPenumbra(r, blockerDepth);
    float passed = 0.0;
    int first = blockerDepth < 0.0 ? 0 : firstTaps / 2;
    int pair = 0;
    for (; pair < first; ++pair) {
        vec4 offsets = jitteredPair(filterJitter, pair) * reach.xyxy;
        passed += testAt(r, offsets.xy) + testAt(r, offsets.zw);
    }
    bool decided = passed == 0.0 || passed == float(2 * first);
    int last = decided ? first : filterTaps / 2;
    for (; pair < last; ++pair) {
        vec4 offsets = jitteredPair(filterJitter, pair) * reach.xyxy;
        passed += testAt(r, offsets.xy) + testAt(r, offsets.zw);
    }
    return last > 0 ? passed / float(2 * last) : 1.0;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    if (r.behind) return;
    visibility = jitteredVisibility(r, meanBlockerDepth(r));
}
