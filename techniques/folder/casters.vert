#include "gl/instance.glsl"

uniform mat4 clipFromWorld;
uniform vec4 lightPlane;  // dot ≥ 0 in front of the light
uniform vec4 unitDepthFromWorld;

out vec3 casterPosition;  // world
out float casterDepth;    // 0 at the light view's near and 1 at its far distance

invariant gl_Position;

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    casterPosition = world.xyz;
    casterDepth = dot(unitDepthFromWorld, world);
    gl_ClipDistance[0] = dot(lightPlane, world);
    gl_Position = clipFromWorld * world;
}
