#include "filtered/moments.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2D blurred;
uniform vec4 unitDepthFromWorld;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    MapPoint point = mapPoint(receiver.position);
    visibility = 1.0;
    if (!receiver.seen || point.behind) return;
    vec2 moments = textureLod(blurred, point.at.xy, 0.0).rg;
    visibility = chebyshevBound(moments, dot(unitDepthFromWorld, vec4(receiver.position, 1.0)), VARIANCE);
}
