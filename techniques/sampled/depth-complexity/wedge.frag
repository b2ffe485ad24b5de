// Counts, for every sample of the light, the layers that end at an edge between it and the light's middle, as a pixel's surface point sees
// them.
#include "gl/receiver.glsl"
#include "volumes/edges.glsl"
#include "volumes/hidden_side.glsl"
#include "volumes/seen_edge.glsl"
#include "sampled/depth-complexity/counters.glsl"

layout(early_fragment_tests) in;

flat in Edge edge;

uniform vec3 middle;
uniform vec4 samplesX[words];  // on the light as seen_edge.glsl has it
uniform vec4 samplesY[words];

/// 1 for those of four samples on the edge's hidden side and −1 for the others, where the edge crosses the line from the light's middle to
/// the sample, else 0.
vec4 crossings(SeenEdge seen, vec3 line, bool ofMiddle, vec4 x, vec4 y) {
    bvec4 ofSample = greaterThan(seen.up * (line.x * x + line.y * y + line.z), vec4(0.0));
    // Of either end on which side of that line it lies: the same for the next edge, which begins there.
    precise vec4 from = x * seen.from.y - y * seen.from.x, to = x * seen.to.y - y * seen.to.x;
    bvec4 crossed = notEqual(greaterThan(from, vec4(0.0)), greaterThan(to, vec4(0.0)));
    vec4 height = (seen.from.z * to - seen.to.z * from) / (to - from);
    vec4 changed = abs(vec4(ofSample) - float(ofMiddle)) * vec4(crossed);
    changed *= vec4(greaterThan(height, vec4(0.0))) * vec4(lessThan(height, vec4(seen.lightHeight)));
    return ofMiddle ? -changed : changed;
}

/// Layers of a triangle for a point on one or the other side of its plane. Rounding decides for the point's own triangle, whose edges are not
/// before the light unless some of it is behind the surface.
int layersBehind(vec4 plane, vec3 point) {
    float side = dot(plane, vec4(point, 1.0));
    return side < 0.0 ? 1 : side > 0.0 ? int(edge.to.w) : 0;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    int change = layersBehind(edge.left, receiver.position) - layersBehind(edge.right, receiver.position);
    SeenEdge seen = seenEdge(edge.from.xyz, edge.to.xyz, receiver.position);
    vec2 part = partBeforeSquare(seen);
    // Often no round: software rasterisers skip loops that no pixel of a block enters, but not branches.
    int count = receiver.seen && change != 0 && part.x < part.y ? words : 0;
    uint first = firstWord(gl_FragCoord.xy);
    vec3 line = cross(seen.from, seen.to);  // through both on the light's plane
    bool ofMiddle = onHiddenSide(edge.from.xyz, edge.to.xyz, middle, receiver.position);
    for (int i = 0; i < count; ++i) {
        ivec4 changes = change * ivec4(crossings(seen, line, ofMiddle, samplesX[i], samplesY[i]));
        int sum = changes.x + (changes.y << 8) + (changes.z << 16) + (changes.w << 24);
        if (sum != 0) atomicAdd(counters[first + uint(i)], uint(sum));
    }
}
