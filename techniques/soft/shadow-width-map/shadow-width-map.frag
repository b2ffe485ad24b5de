#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform vec4 depthFromWorld;
uniform sampler2D linearDepth;  // negative: moving caster
uniform sampler2D widthMap;
uniform float reachOfWidth;     // of a width of 1, in 1 / depth
uniform float widest;           // inner penumbra that the widths reach over

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    MapPoint point = mapPoint(receiver.position);
    float depth = dot(depthFromWorld, vec4(receiver.position, 1.0)), blockerDepth = abs(texture(linearDepth, point.at.xy).r);
    if (point.behind || blockerDepth >= depth) return;
    float penumbra = min(1.0 / blockerDepth - 1.0 / depth, widest);
    visibility = 1.0 - min(texture(widthMap, point.at.xy).r * reachOfWidth / penumbra, 1.0);
}
