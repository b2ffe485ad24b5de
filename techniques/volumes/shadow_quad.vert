// A hard shadow quad: two triangles between an edge and infinity, away from the light's middle; the hidden side is behind it.
#include "volumes/edges.glsl"

layout(std430, binding = 0) readonly buffer Edges { Edge edges[]; };

uniform mat4 clipFromWorld;
uniform vec3 middle;  // of the light

flat out vec4 edgeFrom;
flat out vec3 edgeTo;

void main() {
    int edge = gl_VertexID / 6;
    int corner = gl_VertexID % 6;  // to, from, far from; to, far from, far to
    bool ofTo = corner == 0 || corner == 3 || corner == 5, far = corner == 2 || corner > 3;
    vec3 end = ofTo ? edges[edge].to.xyz : edges[edge].from.xyz;
    gl_Position = clipFromWorld * (far ? vec4(end - middle, 0.0) : vec4(end, 1.0));
    edgeFrom = edges[edge].from;
    edgeTo = edges[edge].to.xyz;
}
