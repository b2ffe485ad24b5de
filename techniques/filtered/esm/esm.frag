#include "filtered/esm/exponential.glsl"
#include "filtered/prefiltered_map.glsl"

uniform float c;

#ifdef PCF_BEYOND
#include "filtered/unit_depth.glsl"

uniform float tolerance;       // of the exponential test above 1
uniform int level;             // of the box's texels: 2^level of the map's
uniform float width;           // of the box in those

/// The share of the box's texels that are not before the receiver's plane.
float percentageCloser(FilteredReceiver r) {
    vec3 normal = normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz);
    vec2 slope = planeSlope(receiverAt(gl_FragCoord.xy).position, normal);
    vec2 size = vec2(textureSize(windowDepths, 0));
    ivec2 middle = ivec2(floor(r.at * size));
    int reach = int(0.5 * width);
    float passed = 0.0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            vec2 texel = (vec2(middle + ivec2(x, y) * (1 << level)) + 0.5) / size;
            vec2 offset = texel - r.at;  // to where the texel's depth was taken
            float unit = unitDepth(texture(windowDepths, texel).r);
            passed += unit >= r.depth + dot(slope, offset) ? 1.0 : 0.0;
        }
    return passed / float((2 * reach + 1) * (2 * reach + 1));
}
#endif

out float visibility;

void main() {
    FilteredReceiver receiver = filteredReceiver();
    visibility = 1.0;
    if (!receiver.known) return;
    float test = meanTest(receiver.depth, filtered(receiver, 0).r, c);
    visibility = exponentialTest(test);
#ifdef PCF_BEYOND
    if (test > 1.0 + tolerance) visibility = percentageCloser(receiver);
#endif
}
