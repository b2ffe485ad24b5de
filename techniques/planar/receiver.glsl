// Whether a pixel sees the planar receiver.
#include "gl/receiver.glsl"

uniform usampler2D ids;
uniform int receiverId;
uniform vec4 plane;
uniform float margin;

bool seesReceiver(vec2 fragCoord) {
    if (int(texelFetch(ids, ivec2(fragCoord), 0).r) != receiverId) return false;
    return abs(dot(plane, vec4(receiverAt(fragCoord).position, 1.0))) <= margin;
}
