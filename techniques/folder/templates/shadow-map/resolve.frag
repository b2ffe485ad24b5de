#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2DShadow depths;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = receiver.seen ? shadowTest(depths, mapPoint(receiver.position)) : 1.0;
}
