#include "gl/instance.glsl"

uniform mat4 clipFromWorld;
#ifdef PLANE
uniform vec4 plane;  // dot ≥ 0 for what is drawn
#endif

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
#ifdef PLANE
    gl_ClipDistance[0] = dot(plane, world);
#endif
    gl_Position = clipFromWorld * world;
}
