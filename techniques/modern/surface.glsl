// How alike the surfaces are that two pixels see.
#include "gl/normal.glsl"
#include "gl/receiver.glsl"

uniform vec4 eyeDepth;  // dot(·, (p, 1)): metres along the view

struct Surface {
    vec3 position, normal;
    float depth;
    bool seen;
};

Surface surfaceAt(ivec2 pixel) {
    Receiver receiver = receiverAt(vec2(pixel));
    return Surface(receiver.position, normalAt(vec2(pixel)), dot(eyeDepth, vec4(receiver.position, 1.0)), receiver.seen);
}

/// In [0, 1]; Schied et al. eq. 3 and 4. A depth is compared with the plane of the other pixel's surface, in hundredths of its distance.
float likeness(Surface a, Surface b) {
    if (!b.seen) return 0.0;
    float beside = abs(dot(a.normal, b.position - a.position)) / (0.01 * a.depth);
    return exp(-beside) * pow(max(dot(a.normal, b.normal), 0.0), 128.0);
}
