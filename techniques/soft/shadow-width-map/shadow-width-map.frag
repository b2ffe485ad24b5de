#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform vec4 depthFromWorld;
uniform sampler2D linearDepth;  // negative: moving caster
uniform sampler2D widthMap;     // passes
uniform float reachPerPass;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    MapPoint point = mapPoint(receiver.position);
    float depth = dot(depthFromWorld, vec4(receiver.position, 1.0)), blockerDepth = abs(texture(linearDepth, point.at.xy).r);
    if (point.behind || blockerDepth >= depth) return;
    float penumbra = 1.0 / blockerDepth - 1.0 / depth;
    visibility = 1.0 - min(texture(widthMap, point.at.xy).r * reachPerPass / penumbra, 1.0);
}
