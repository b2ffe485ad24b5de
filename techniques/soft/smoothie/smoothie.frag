// The three cases of the course's "Compute Shadows".
#include "soft/outline_receiver.glsl"

uniform sampler2D smoothies;  // depth of the nearest, least alpha

out float visibility;

void main() {
    OutlineReceiver r = outlineReceiver();
    vec2 smoothie = texture(smoothies, r.at).rg;
    visibility = 1.0;
    if (r.unseen) return;
    if (isForemost(r) && r.depth > smoothie.x) visibility = clamp(smoothie.y, 0.0, 1.0);
    if (blocked(r)) visibility = 0.0;
}
