// The pixel's soft visibility by the parameters `turn` and `turned`; negative where the pixel sees nothing.
#include "gl/normal.glsl"
#include "gl/receiver.glsl"
#include "modern/pcss-vogel/pcss.glsl"

uniform int frame;
uniform int seed;

float softPixel() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    if (!receiver.seen) return -1.0;
    SoftReceiver soft = softReceiver(receiver.position, normalAt(gl_FragCoord.xy));
    if (soft.behind) return 1.0;
    float turn = turnOf(gl_FragCoord.xy, frame, seed);
#ifdef TURNED_FILTER
    vec2 turns = vec2(0.0, turn);
#else
    vec2 turns = vec2(turn);
#endif
    return softVisibility(soft, turns);
}
