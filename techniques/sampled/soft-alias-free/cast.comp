// The light samples that a triangle hides from a pixel.
#include "sampled/soft-alias-free/samples.glsl"
#include "shared/maps/pixel_lists.glsl"

uniform vec3 lightCentre;
uniform float slack;

const int roundsOfShade = WORDS;

/// Everything is taken relative to the point, so that what is computed is small where the decision is close. The normals of the planes
/// through an edge that two triangles share differ in sign alone: no sample falls between them.
bool shade(uint pixel, vec3 point, vec3 v0, vec3 v1, vec3 v2) {
    vec3 a = v0 - point, b = v1 - point, c = v2 - point, centre = lightCentre - point;
    vec3 normal = cross(b - a, c - a);
    float height = dot(a, normal);
    float side = height < 0.0 ? -1.0 : 1.0;  // the samples beyond the triangle lie on this side of it
    precise vec3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
    Hull hull = Hull(side * onLight(ab, centre), side * onLight(bc, centre), side * onLight(ca, centre),
                     side * onLight(normal, centre) - vec3(abs(height), 0.0, 0.0));
    float inside = min(min(highest(hull.ab), highest(hull.bc)), highest(hull.ca));
    bool reaches = inside >= 0.0 && highest(hull.face) > 0.0 && abs(height) > slack * length(normal);
    int words = reaches ? WORDS : 0;
    for (int word = 0; word < words; ++word) {
        uint hidden = wordHidden(hull, word);
        if (hidden != 0u) atomicOr(results[pixel * uint(WORDS) + uint(word)], hidden);
    }
    return false;
}

#include "shared/maps/cast_triangles.glsl"
