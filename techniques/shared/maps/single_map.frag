#include "shared/maps/tested_point.glsl"

uniform sampler2DShadow depthMap;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = receiver.seen ? shadowTest(depthMap, testedPoint(receiver)) : 1.0;
}
