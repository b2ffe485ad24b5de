// Which light samples lie behind planes through a pixel's point (sampled/soft-alias-free/soft-alias-free.cpp). In the light's plane, such
// a plane is a line; a word's 32 samples are tested in groups of four.
uniform vec4 samplesAcross[8 * WORDS];  // metres from the light's centre, to the right …
uniform vec4 samplesUp[8 * WORDS];      // … and up
uniform vec3 lightRight;
uniform vec3 lightUp;
uniform vec2 halfLight;  // metres from its centre to the sides of its bounding rectangle

/// A plane through the origin with this normal, on the light whose centre is at `centre`: the height above it at the centre, and by how
/// much it grows for each metre to the right and up.
vec3 onLight(vec3 normal, vec3 centre) {
    return vec3(dot(centre, normal), dot(lightRight, normal), dot(lightUp, normal));
}

/// The greatest height of a point of the light.
float highest(vec3 line) {
    return line.x + dot(abs(line.yz), halfLight);
}

/// Whether a triangle hides nothing of the light from the origin since it lies beyond one of the four planes through the origin and the
/// light's sides. Never of a linear light, which has no plane of its own.
bool besideLight(vec3 a, vec3 b, vec3 c, vec3 centre) {
    vec3 ahead = cross(lightRight, lightUp);
    if (dot(ahead, centre) < 0.0) ahead = -ahead;
    float distance = dot(ahead, centre);
    vec3 depths = vec3(dot(ahead, a), dot(ahead, b), dot(ahead, c));
    // How far from the light's centre the corners' images lie on its plane, times their depths: those need no division.
    vec3 across = distance * vec3(dot(lightRight, a), dot(lightRight, b), dot(lightRight, c)) - dot(lightRight, centre) * depths;
    vec3 up = distance * vec3(dot(lightUp, a), dot(lightUp, b), dot(lightUp, c)) - dot(lightUp, centre) * depths;
    // No term of these differences is greater than the light's distance times the farthest corner's, and the rounding of floats is a
    // small part of this: a triangle that touches a plane is not beyond it.
    float rounding = 1e-5 * length(centre) * sqrt(max(max(dot(a, a), dot(b, b)), dot(c, c)));
    vec3 wide = halfLight.x * depths, high = halfLight.y * depths;
    return all(greaterThan(across, wide + rounding)) || all(lessThan(across, -wide - rounding)) ||
           all(greaterThan(up, high + rounding)) || all(lessThan(up, -high - rounding));
}

vec4 heights(vec3 line, int group) {
    return line.x + line.y * samplesAcross[group] + line.z * samplesUp[group];
}

/// Four lines with the samples of interest on their positive side.
struct Hull {
    vec3 ab, bc, ca;  // of a triangle's edges: samples on a line count
    vec3 face;        // of the triangle's own plane: samples on it do not count
};

uint fourHidden(Hull hull, int group) {
    vec4 inside = min(min(heights(hull.ab, group), heights(hull.bc, group)), heights(hull.ca, group));
    bvec4 hidden = greaterThan(heights(hull.face, group), vec4(0.0));
    uvec4 bits = mix(uvec4(0u), uvec4(1u, 2u, 4u, 8u), hidden);
    bits = mix(uvec4(0u), bits, greaterThanEqual(inside, vec4(0.0)));
    return bits.x | bits.y | bits.z | bits.w;
}

/// The hidden samples of one word. Written out, since every round of a loop counts (shared/maps/cast_triangles.glsl).
uint wordHidden(Hull hull, int word) {
    int group = 8 * word;
    return fourHidden(hull, group) | fourHidden(hull, group + 1) << 4 | fourHidden(hull, group + 2) << 8 |
           fourHidden(hull, group + 3) << 12 | fourHidden(hull, group + 4) << 16 | fourHidden(hull, group + 5) << 20 |
           fourHidden(hull, group + 6) << 24 | fourHidden(hull, group + 7) << 28;
}
