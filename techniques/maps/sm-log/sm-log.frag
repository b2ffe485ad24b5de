#include "gl/receiver.glsl"
#include "maps/sm-log/log.glsl"

uniform sampler2DShadow depthMap;

out float visibility;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    vec4 h = planeFromWorld * vec4(receiver.position, 1.0);
    bool held = receiver.seen && h.w > 0.0 && h.y > 0.0;
    visibility = held ? texture(depthMap, vec3(onMap(h.xy / h.w), min(0.5 + 0.5 * h.z / h.w, 1.0))) : 1.0;
}
