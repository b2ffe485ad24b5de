// The shadow test in the finest page that is there, from the level on that the pixel asks for. Lit where there is none.
#include "gl/receiver.glsl"
#include "modern/sm-clipmap/pages.glsl"

layout(std430, binding = 4) readonly buffer Table { uint slots[]; };  // of each page: 0, or 1 + the slot of its map

uniform sampler2D depths;
uniform int texels;   // along a page
uniform int columns;  // of slots

out float visibility;

void main() {
    visibility = 1.0;
    Receiver receiver = receiverAt(gl_FragCoord.xy);
    if (!receiver.seen) return;
    Place place = placeOf(receiver.position);
    for (int level = place.level; level < levels; ++level) {
        int entry = entryOf(place, level);
        int slot = entry < 0 ? -1 : int(slots[entry]) - 1;
        if (slot < 0) continue;
        vec2 inPage = fract(place.at.xy / float(1 << level));
        ivec2 texel = min(ivec2(inPage * float(texels)), texels - 1);
        ivec2 corner = texels * ivec2(slot % columns, slot / columns);
        visibility = place.at.z <= texelFetch(depths, corner + texel, 0).r ? 1.0 : 0.0;
        return;
    }
}
