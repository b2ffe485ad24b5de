#include "gl/instance.glsl"

uniform mat4 clipFromWorld;
uniform vec4 lightPlane;

flat out uint moving;
#ifdef SURFACE
flat out uint surface;
#endif

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    moving = idAndMoving.y;
#ifdef SURFACE
    surface = idAndMoving.x;
#endif
    gl_ClipDistance[0] = dot(lightPlane, world);
    gl_Position = clipFromWorld * world;  // w is the depth
}
