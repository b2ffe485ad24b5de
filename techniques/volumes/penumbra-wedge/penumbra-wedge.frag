// What one edge hides of the light from a pixel's surface point, beside what hides the light's middle (course, rasterizeWedge).
#include "gl/receiver.glsl"
#include "volumes/edges.glsl"
#include "volumes/hidden_side.glsl"
#include "volumes/penumbra-wedge/coverage.glsl"

flat in Edge edge;

uniform vec3 middle;
uniform int disk;

out float hidden;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    SeenEdge seen = seenEdge(edge.from.xyz, edge.to.xyz, receiver.position);
    vec2 part = partBeforeSquare(seen);
    float coverage = 0.0;
    // A loop, for software rasterisers skip loops that no pixel of a block enters, but not branches.
    for (int i = 0; i < int(receiver.seen && part.x < part.y); ++i) {
        vec2 a = projected(seen, part.x), b = projected(seen, part.y);
        coverage = max(disk == 1 ? coverageOfDisk(a, b) : coverageOfSquare(a, b), 0.0);
    }
    bool ofMiddle = onHiddenSide(edge.from.xyz, edge.to.xyz, middle, receiver.position);
    hidden = edge.from.w * (ofMiddle ? -coverage : coverage);
}
