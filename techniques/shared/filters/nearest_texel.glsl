// The nearest texel around a receiver that is blocked, or that is lit: a search in a spiral (Brabec and Seidel 2002).
#include "shared/maps/light_receiver.glsl"

uniform vec2 texelReach;   // from texel to texel along x and y (shared/filters/nearest_texel.h)
uniform int searchRadius;  // texels

/// Whether what the map stores at `offset` from the receiver blocks its light: defined by the shader that includes this.
bool blocks(vec4 stored, LightReceiver r, vec2 offset);

struct Nearest {
    float distance;  // in the units of texelReach; that of the search's end if nothing was found
    float depth;     // of the texel's occluder; negative if nothing was found
};

/// The texel nearest to the receiver that is blocked, or lit, within `reach`. Texels are squares: the distance ends where the texel
/// begins, which is where the raster has the edge.
Nearest nearestTexel(sampler2D map, LightReceiver r, bool blocked, float reach) {
    vec2 texels = vec2(textureSize(map, 0));
    vec2 middle = floor(r.at * texels) + 0.5 - r.at * texels;  // of the receiver's own texel, from the receiver
    float perRing = min(texelReach.x, texelReach.y);
    Nearest nearest = Nearest(reach, -1.0);
    ivec2 cell = ivec2(0), turn = ivec2(0, -1);
    for (int ring = 0; ring <= searchRadius && float(ring - 1) * perRing < nearest.distance; ring = max(abs(cell.x), abs(cell.y))) {
        vec2 offset = middle + vec2(cell);
        vec4 stored = texture(map, r.at + offset / texels);
        float distance = length(max(abs(offset) - 0.5, 0.0) * texelReach);
        if (distance < nearest.distance && blocks(stored, r, offset / texels) == blocked) nearest = Nearest(distance, stored.r);
        if (cell.x == cell.y || (cell.x < 0 && cell.x == -cell.y) || (cell.x > 0 && cell.x == 1 - cell.y)) turn = ivec2(-turn.y, turn.x);
        cell += turn;
    }
    return nearest;
}
