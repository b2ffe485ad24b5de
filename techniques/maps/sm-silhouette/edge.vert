// An edge as a quad that covers the centres of all cells of the dual grid that the edge crosses.
layout(location = 0) in vec3 edgeFrom;
layout(location = 1) in vec3 edgeTo;

uniform int cells;  // per side of the silhouette map

flat out vec3 from;
flat out vec3 to;

void main() {
    from = edgeFrom;
    to = edgeTo;
    vec2 along = to.xy - from.xy;
    along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    const float reach = 1.0;  // no centre of a crossed cell is further away than half a diagonal, 0.71
    vec2 end = (gl_VertexID & 1) == 0 ? from.xy - reach * along : to.xy + reach * along;
    vec2 corner = end + ((gl_VertexID & 2) == 0 ? -reach : reach) * across;
    gl_Position = vec4(2.0 * corner / float(cells) - 1.0, 0.0, 1.0);
}
