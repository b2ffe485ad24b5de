// A caster's vertex flattened onto the receiver's plane. What lies under the plane, or beyond the light, casts nothing onto it.
#include "gl/instance.glsl"

uniform mat4 clipFromWorld;  // view · projection onto the plane
uniform vec4 plane;
uniform float margin;
uniform vec2 lightHeight;  // dot(plane, light), and w of the light

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    float height = dot(plane, world);
    gl_ClipDistance[0] = height - margin;
    gl_ClipDistance[1] = lightHeight.x - lightHeight.y * height - margin;
    gl_Position = clipFromWorld * world;
}
