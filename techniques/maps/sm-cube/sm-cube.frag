#include "gl/receiver.glsl"
#include "maps/depth_atlas.glsl"

uniform vec3 light;

out float visibility;

/// Side of the cube that a direction leaves by (maps/cube_view.h).
int sideOf(vec3 direction) {
    vec3 size = abs(direction);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = receiver.seen ? atlasTest(sideOf(receiver.position - light), receiver.position) : 1.0;
}
