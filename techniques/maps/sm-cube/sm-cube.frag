#include "gl/receiver.glsl"
#include "shared/maps/cube_side.glsl"
#include "shared/maps/depth_atlas.glsl"

uniform vec4 lightPlace;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = receiver.seen ? atlasTest(sideOf(receiver.position - lightPlace.xyz), receiver.position) : 1.0;
}
