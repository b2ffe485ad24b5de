#if defined TAPS_25_49
#define SEARCH_TAPS 25
#define FILTER_TAPS 49
#define searchTaps searchGrid
#define filterTaps filterGrid
#elif defined TAPS_32_32
#define SEARCH_TAPS 32
#define FILTER_TAPS 32
#else
#define SEARCH_TAPS 16
#define FILTER_TAPS 16
#endif
#define linearisation metreLinearisation
#include "gl/receiver.glsl"
#include "shared/filters/pcss.glsl"

uniform sampler2D normals;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    if (r.behind) return;
    float blocker = averageBlockerDepth(r, SEARCH_TAPS);
    visibility = pcssVisibility(r, blocker, blocker < 0.0 ? 0 : FILTER_TAPS);  // without blockers nothing is filtered (Fernando 2005)
}
