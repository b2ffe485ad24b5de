#include "filtered/moments.glsl"
#include "gl/receiver.glsl"
#include "shared/maps/light_space.glsl"

uniform sampler2D means;
uniform sampler2D previous_mean;
uniform int historyFrames;

out float mean;

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    vec3 at = mapPoint(receiver.position).at;
    float lit = chebyshevBound(texture(means, at.xy).rg, at.z, 1e-6), before = texelFetch(previous_mean, ivec2(gl_FragCoord.xy), 0).r;
    mean = mix(before, receiver.seen ? lit : 1.0, 1.0 / float(historyFrames + 1));
}
