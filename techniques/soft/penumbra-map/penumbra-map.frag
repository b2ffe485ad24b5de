// The shadow map's depth and the penumbra map's intensity.
#include "soft/outline_receiver.glsl"

uniform sampler2D penumbrae;

out float visibility;

void main() {
    OutlineReceiver r = outlineReceiver();
    visibility = 1.0;
    if (r.unseen) return;
    if (isForemost(r)) visibility = texture(penumbrae, r.at).r;
    if (blocked(r)) visibility = 0.0;
}
