// The light samples that a triangle hides from a pixel.
#include "sampled/soft-alias-free/samples.glsl"
#include "shared/maps/large_triangles.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform vec3 lightCentre;
uniform float slack;

const int roundsOfShade = WORDS + 1;

/// The light samples that a triangle hides from the origin: relative to the point, what is computed is small where the decision is close.
/// The normals of the planes through an edge that two triangles share differ in sign alone: no sample falls between them.
Hull hullOf(vec3 a, vec3 b, vec3 c, vec3 centre) {
    vec3 normal = cross(b - a, c - a);
    float height = dot(a, normal);
    float side = height < 0.0 ? -1.0 : 1.0;  // the samples beyond the triangle lie on this side of it
    precise vec3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
    return Hull(side * onLight(ab, centre), side * onLight(bc, centre), side * onLight(ca, centre),
                side * onLight(normal, centre) - vec3(abs(height), 0.0, 0.0));
}

/// Whether the triangle may hide a part of the light's bounding rectangle from the point.
bool reaches(vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    vec3 a = v0 - point, b = v1 - point, c = v2 - point, centre = lightCentre - point;
    vec3 normal = cross(b - a, c - a);
    Hull hull = hullOf(a, b, c, centre);
    float inside = min(min(highest(hull.ab), highest(hull.bc)), highest(hull.ca));
    return inside >= 0.0 && highest(hull.face) > 0.0 && abs(dot(a, normal)) > slack * length(normal) && !besideLight(a, b, c, centre);
}

void orHidden(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    Hull hull = hullOf(v0 - point, v1 - point, v2 - point, lightCentre - point);
    for (int word = 0; word < WORDS; ++word) {
        uint hidden = wordHidden(hull, word);
        if (hidden != 0u) atomicOr(results[pixel * uint(WORDS) + uint(word)], hidden);
    }
}

void shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    if (reaches(point, v0, v1, v2)) orHidden(pixel, point, v0, v1, v2);
}

/// Invocations that run in step test their samples together as often as one of them has triangles that reach it, not once for each
/// triangle that reaches one of them.
void shadeLarge(uint pixel, vec3 point, uint first, uint which) {
    uint reaching = 0u;
    for (; which != 0u; which &= which - 1u) {
        uint triangle = uint(findLSB(which)), corner = 3u * (first + triangle);
        if (reaches(point, largeCorner(corner), largeCorner(corner + 1u), largeCorner(corner + 2u))) reaching |= 1u << triangle;
    }
    for (; reaching != 0u; reaching &= reaching - 1u) {
        uint corner = 3u * (first + uint(findLSB(reaching)));
        orHidden(pixel, point, largeCorner(corner), largeCorner(corner + 1u), largeCorner(corner + 2u));
    }
}

#include "shared/maps/cast_triangles.glsl"
