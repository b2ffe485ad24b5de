// What blocks a receiver before a map of linear depth, and how far blocker search and filter of percentage-closer soft shadows reach.
#include "shared/maps/light_receiver.glsl"
#include "shared/maps/linearised_map.glsl"

uniform vec2 lightHalfSize;      // half the light's sides along map x and y, metres
uniform vec2 mapSpan;            // width and height of the map at unit depth
uniform float nearDepth;         // no caster is nearer to the light

bool blocks(float mapDepth, LightReceiver r, vec2 offset) {
    // depth < 1 / (1 / depth of the plane), without the division.
    return mapDepth < nothingInTheWay && mapDepth * planeInverseDepth(r, offset) < 1.0;
}

/// Half the sides of the light's projection from the receiver onto the near plane of the map, in map x and y: blockers lie in it.
vec2 searchWindow(LightReceiver r) {
    return lightHalfSize * max(r.depth - nearDepth, 0.0) / (r.depth * nearDepth) / mapSpan;
}

/// Half the penumbra's widths by similar triangles (Zápotocký eq. 3.3), in map x and y.
vec2 halfPenumbra(LightReceiver r, float blockerDepth) {
    return lightHalfSize * max(r.depth - blockerDepth, 0.0) / blockerDepth / (r.depth * mapSpan);
}
