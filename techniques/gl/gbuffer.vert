#include "gl/instance.glsl"

uniform mat4 clipFromWorld;

out vec3 world;
flat out uint surfaceId;
#ifdef MOTION
out vec3 previousWorld;
#endif

void main() {
    world = worldPosition(objectPosition);
    surfaceId = idAndMoving.x;
#ifdef MOTION
    previousWorld = previousWorldPosition(previousObjectPosition);
#endif
    gl_Position = clipFromWorld * vec4(world, 1.0);
}
