// A pixel's place in the shadow buffer, and what the last frame left there (Scherzer 4.1.2). ψ is the occluded fraction; what is
// shown is 1 − ψ. RELATIVE_DEPTH: 1 if the tolerance of depths is relative (eq. 4.8), 0 if it is in metres (eq. 4.4).
#include "gl/half.glsl"
#include "gl/receiver.glsl"
#include "sampled/estimators.glsl"

uniform vec2 gbufferOrigin;      // the pixel of the shadow buffer that the G-buffer begins at
uniform sampler2D previousPositions;
uniform sampler2D shadowBuffer;  // ρ, n, linear eye depth, and what the technique keeps beside them; n = 0: background
uniform mat4 previousClipFromWorld;
uniform vec4 eyeDepth;           // dot(·, (p, 1)) = linear depth from the eye
uniform vec4 previousEyeDepth;
uniform float epsilon;
uniform int hasHistory;

layout(location = 0) out float visibility;
layout(location = 1) out vec4 newShadowBuffer;

bool sameDepth(float now, float before) {
#if RELATIVE_DEPTH
    return abs(1.0 - now / before) < epsilon;
#else
    return abs(now - before) < epsilon;
#endif
}

/// Of the G-buffer.
ivec2 ownPixel() {
    return ivec2(gl_FragCoord.xy - gbufferOrigin);
}

float depthFromEye(Receiver receiver) {
    return dot(eyeDepth, vec4(receiver.position, 1.0));
}

struct Remembered {
    vec2 at;      // where the last frame's buffer showed the pixel's surface point
    bool inside;  // it had such a place
    bool known;   // and showed that point there: values holds
    float depth;  // of that point from the last frame's eye, as the buffer's depths are
    vec4 values;
};

Remembered remembered() {
    vec3 before = texelFetch(previousPositions, ownPixel(), 0).xyz;
    vec4 h = previousClipFromWorld * vec4(before, 1.0);
    vec2 at = h.xy / h.w * 0.5 + 0.5;
    bool inside = hasHistory == 1 && all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
    vec4 values = texture(shadowBuffer, at);
    float depth = dot(previousEyeDepth, vec4(before, 1.0));
    bool known = inside && values.y > 0.5 && sameDepth(depth, values.z);
    return Remembered(at, inside, known, depth, values);
}

void showBackground() {
    visibility = 1.0;
    newShadowBuffer = vec4(0.0);
}
