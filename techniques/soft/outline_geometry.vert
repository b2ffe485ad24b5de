// A vertex of the triangles that are attached to outlines (soft/outline_geometry.h).
#include "gl/instance.glsl"

layout(location = 9) in vec3 offset; // light space
layout(location = 10) in float value;

uniform mat4 clipFromWorld;
uniform mat4 worldFromLight;
uniform vec4 depthFromWorld;

out float depth;                     // metres from the light's plane
out float acrossSurface;             // the value, linear on the triangle in the world
noperspective out float acrossImage; // the value, linear in the light's image

void main() {
    vec4 world = vec4(worldPosition(objectPosition), 1.0);
    vec4 moved = vec4(mat3(worldFromLight) * offset, 0.0);
    depth = dot(depthFromWorld, world + moved);
    acrossSurface = value;
    acrossImage = value;
    // Casters are drawn at clipFromWorld * world: without an offset nothing is added to it, and no crack opens beside them.
    gl_Position = clipFromWorld * world + clipFromWorld * moved;
}
