#include "shared/maps/caster_depth.glsl"

flat in uint moving;
#ifdef SURFACE
flat in uint surface;
#endif

uniform vec2 bias; // slope factor, constant in metres
#ifdef PEEL
uniform sampler2D depthBefore; // of the layer that is peeled off, the same to the last bit where it is drawn again
#endif

out vec4 stored;

void main() {
    float depth = 1.0 / casterInverseDepth(bias.x) + bias.y;
#ifdef PEEL
    if (gl_FragCoord.z <= texelFetch(depthBefore, ivec2(gl_FragCoord.xy), 0).r) discard;
#endif
#ifdef SURFACE
    stored = vec4(depth, float(surface), 0.0, 0.0);
#else
    stored = vec4(moving != 0u ? -depth : depth);
#endif
}
