// A penumbra wedge's surface (techniques/shared/casters/wedges.h).
#include "volumes/edges.glsl"

struct Wedge {
    Edge edge;
    vec4 corners[8];
};
layout(std430, binding = 0) readonly buffer Wedges { Wedge wedges[]; };

uniform mat4 clipFromWorld;

flat out Edge edge;

void main() {
    int wedge = gl_VertexID / 8;
    gl_Position = clipFromWorld * wedges[wedge].corners[gl_VertexID % 8];
    edge = wedges[wedge].edge;
}
