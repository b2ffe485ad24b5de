#include "gl/receiver.glsl"
#include "shared/filters/nearest_texel.glsl"

uniform sampler2D normals;
uniform sampler2D linearDepth;  // negative: moving caster
uniform sampler2D skirt;        // attenuation, 1 / depth
uniform float skirtReach;       // where the attenuation reaches 0, in the units of texelReach

out float visibility;

bool blocks(vec4 stored, LightReceiver r, vec2 offset) {
    return abs(stored.r) < planeDepth(r, offset);
}

/// The edge's own texel has attenuation 1, the edge lies half a texel further. The least depth may come from anywhere within the skirt:
/// an edge that may be one of the receiver's own plane casts no shadow.
float outerPenumbra(LightReceiver r) {
    vec2 texels = vec2(textureSize(skirt, 0));
    float attenuation = texture(skirt, r.at).r;
    float before = texelFetch(skirt, ivec2(r.at * texels), 0).g - 1.0 / r.depth;
    if (attenuation <= 0.0 || before <= dot(abs(r.inverseSlope), (skirtReach / texelReach + 1.0) / texels)) return 1.0;
    float distance = (1.0 - attenuation) * skirtReach - 0.5 * min(texelReach.x, texelReach.y);
    return 0.5 + 0.5 * clamp(distance / min(before, skirtReach), 0.0, 1.0);
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
