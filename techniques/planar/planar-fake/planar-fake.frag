#include "planar/receiver.glsl"

uniform mat4 mapFromWorld;  // x, y in [0, 1] over the receiver
uniform sampler2D shadow;   // 0 where the projected shadow lies

out float visibility;

void main() {
    visibility = 1.0;
    if (!seesReceiver(gl_FragCoord.xy)) return;
    vec2 at = (mapFromWorld * vec4(receiverAt(gl_FragCoord.xy).position, 1.0)).xy;
    vec2 texel = 1.0 / vec2(textureSize(shadow, 0));
    float lit = 0.0;
    for (int y = 0; y < KERNEL; ++y)
        for (int x = 0; x < KERNEL; ++x) lit += texture(shadow, at + (vec2(x, y) - 0.5 * float(KERNEL - 1)) * texel).r;
    visibility = lit / float(KERNEL * KERNEL);
}
