#include "gl/instance.glsl"

uniform mat4 clipFromWorld;
uniform vec4 lightPlane;  // dot ≥ 0 in front of the light
#ifdef CASTER_PLANE
uniform vec4 casterPlane;  // dot ≥ 0 for what casts
#endif

invariant gl_Position;  // passes that peel compare depths for equality

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    gl_ClipDistance[0] = dot(lightPlane, world);
#ifdef CASTER_PLANE
    gl_ClipDistance[1] = dot(casterPlane, world);
#endif
    gl_Position = clipFromWorld * world;
}
