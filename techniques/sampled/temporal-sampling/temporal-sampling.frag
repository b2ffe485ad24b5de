#include "sampled/shadow_buffer.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2DShadow depthMap;

void main() {
    Receiver receiver = receiverAt(vec2(ownPixel()));
    if (!receiver.seen) {
        showBackground();
        return;
    }
    float tau = 1.0 - shadowTest(depthMap, mapPoint(receiver.position));
    Remembered old = remembered();
    vec2 counts = withSample(old.known ? old.values.xy : vec2(0.0), tau);
    newShadowBuffer = toHalf(vec4(counts, depthFromEye(receiver), 0.0));
    visibility = 1.0 - occlusionEstimate(counts.x, counts.y);
}
