#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2D blurred;
uniform vec4 unitDepthFromWorld;

out float visibility;

/// Chebyshev: the largest share of depths beyond `depth` that a distribution with these moments can have.
float litShare(vec2 moments, float depth) {
    if (depth <= moments.x) return 1.0;
    float variance = max(moments.y - moments.x * moments.x, VARIANCE);
    float beyond = depth - moments.x;
    return variance / (variance + beyond * beyond);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    vec2 moments = textureLod(blurred, point.at.xy, 0.0).rg;
    visibility = litShare(moments, dot(unitDepthFromWorld, vec4(receiver.position, 1.0)));
}
