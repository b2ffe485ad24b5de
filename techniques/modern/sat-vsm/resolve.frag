#include "filtered/footprint.glsl"
#include "filtered/moments.glsl"
#include "modern/sat-vsm/summed_moments.glsl"

uniform usampler2D sums;

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver(float(MAP));
    visibility = 1.0;
    if (!receiver.known) return;
    mat2 perPixel = footprint(receiverAt(gl_FragCoord.xy).position, normalAt(gl_FragCoord.xy));
    vec2 covered = float(MAP) * (abs(perPixel[0]) + abs(perPixel[1]));  // texels
    vec2 reach = 0.5 * max(covered, vec2(KERNEL)), at = float(MAP) * receiver.at;
    visibility = chebyshevBound(meanMoments(sums, at - reach, at + reach), receiver.depth, VARIANCE);
}
