#include "planar/planar-fake/box.glsl"
#include "planar/receiver.glsl"

uniform mat4 mapFromWorld;  // x, y in [0, 1] over the receiver

out float visibility;

void main() {
    visibility = 1.0;
    if (!seesReceiver(gl_FragCoord.xy)) return;
    visibility = boxMean((mapFromWorld * vec4(receiverAt(gl_FragCoord.xy).position, 1.0)).xy);
}
