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
    visibility = pcssVisibility(r, averageBlockerDepth(r, SEARCH_TAPS), FILTER_TAPS);
}
