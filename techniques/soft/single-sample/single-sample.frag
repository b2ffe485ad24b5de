#include "gl/receiver.glsl"
#include "shared/filters/nearest_texel.glsl"

uniform sampler2D normals;
uniform usampler2D ids;
uniform sampler2D idMap;  // linear depth, surface id
uniform sampler2D tiles;
uniform float nearDepth;

out float visibility;

float ownId;

bool blocks(vec4 stored, LightReceiver r, vec2 offset) {
    return stored.g != ownId && stored.r < planeDepth(r, offset);
}

/// Least depth of the tiles that may hold another surface within the widest penumbra around the receiver; 1e30 without such a tile.
float nearestOther(LightReceiver r) {
    vec2 window = min((1.0 / nearDepth - 1.0 / r.depth) / texelReach, float(searchRadius));
    vec2 texels = vec2(textureSize(idMap, 0));
    ivec2 first = ivec2(clamp(r.at * texels - window, vec2(0.0), texels - 1.0)) / TILE_SIDE;
    ivec2 last = ivec2(clamp(r.at * texels + window, vec2(0.0), texels - 1.0)) / TILE_SIDE;
    float depth = 1e30;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            vec2 tile = texelFetch(tiles, ivec2(x, y), 0).rg;
            if (tile.x != ownId) depth = min(depth, tile.y);
        }
    return depth;
}

/// r_max: how far a penumbra reaches to each side of its hard edge, 1 / blocker depth − 1 / receiver depth by similar triangles, or what
/// the search is sure to have seen.
float penumbraReach(float blockerDepth, float depth) {
    return clamp(1.0 / blockerDepth - 1.0 / depth, 0.0, float(searchRadius) * min(texelReach.x, texelReach.y));
}

float outerPenumbra(LightReceiver r) {
    float other = nearestOther(r);
    if (other > 1e29) return 1.0;
    Nearest blocked = nearestTexel(idMap, r, true, penumbraReach(max(other, nearDepth), r.depth));
    if (blocked.depth < 0.0) return 1.0;
    return 0.5 + 0.5 * min(blocked.distance / penumbraReach(blocked.depth, r.depth), 1.0);
}

float innerPenumbra(LightReceiver r, float blockerDepth) {
    float reach = penumbraReach(blockerDepth, r.depth);
    return 0.5 - 0.5 * nearestTexel(idMap, r, false, reach).distance / reach;
}

void main() {
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    visibility = 1.0;
    if (!receiver.seen) return;
    ownId = float(texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r);
    LightReceiver r = lightReceiver(receiver.position, normalize(texelFetch(normals, ivec2(gl_FragCoord.xy), 0).xyz));
    if (r.behind) return;
    vec2 stored = texture(idMap, r.at).rg;
    visibility = stored.g == ownId || stored.r >= r.depth ? outerPenumbra(r) : innerPenumbra(r, stored.r);
}
