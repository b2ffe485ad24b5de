#include "gl/instance.glsl"

uniform mat4 clipFromWorld;
uniform vec4 lightPlane;  // dot ≥ 0 in front of the light

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    gl_ClipDistance[0] = dot(lightPlane, world);
    gl_Position = clipFromWorld * world;
}
