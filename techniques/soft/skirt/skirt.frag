#include "gl/receiver.glsl"
#include "shared/filters/nearest_texel.glsl"

uniform sampler2D normals;
uniform sampler2D linearDepth;  // negative: moving caster
uniform sampler2D skirt;        // attenuation, 1 / depth
uniform float edgeAttenuation;  // half a texel from the middle of an edge's own texel, where the edge lies
uniform float fallOver;         // distance over which attenuation falls by 1, in the units of texelReach
uniform float skirtReach;       // where it reaches 0
uniform float depthReach;       // how far the least depth comes

out float visibility;

bool blocks(vec4 stored, LightReceiver r, vec2 offset) {
    return abs(stored.r) < planeDepth(r, offset);
}

/// The least depth may come from anywhere within the skirt: an edge that may be one of the receiver's own plane casts no shadow.
float outerPenumbra(LightReceiver r) {
    vec2 texels = vec2(textureSize(skirt, 0));
    float attenuation = texture(skirt, r.at).r;
    float before = texelFetch(skirt, ivec2(r.at * texels), 0).g - 1.0 / r.depth;
    if (attenuation <= 0.0 || before <= dot(abs(r.inverseSlope), (depthReach / texelReach + 1.0) / texels)) return 1.0;
    return 0.5 + 0.5 * clamp((edgeAttenuation - attenuation) * fallOver / min(before, skirtReach), 0.0, 1.0);
}

float innerPenumbra(LightReceiver r, float blockerDepth) {
    float reach = min(1.0 / blockerDepth - 1.0 / r.depth, skirtReach);
    return 0.5 - 0.5 * nearestTexel(linearDepth, r, false, reach).distance / reach;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    if (r.behind) return;
    float stored = abs(texture(linearDepth, r.at).r);
    visibility = stored < r.depth ? innerPenumbra(r, stored) : outerPenumbra(r);
}
