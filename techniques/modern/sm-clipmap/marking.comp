// How many pixels ask for each page.
#include "gl/invocation.glsl"
#include "gl/receiver.glsl"
#include "modern/sm-clipmap/pages.glsl"

layout(std430, binding = 3) buffer Asked { uint asked[]; };

void main() {
    ivec2 size = textureSize(positions, 0);
    int pixel = int(invocation());
    if (pixel >= size.x * size.y) return;
    Receiver receiver = receiverAt(vec2(pixel % size.x, pixel / size.x));
    if (!receiver.seen) return;
    Place place = placeOf(receiver.position);
    int entry = entryOf(place, place.level);
    if (entry >= 0) atomicAdd(asked[entry], 1u);
}
